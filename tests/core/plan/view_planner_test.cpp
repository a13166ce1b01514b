#include "core/plan/view_planner.h"

#include <catch2/catch.hpp>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/plan/spacing.h"
#include "raster_cpu/cpu_rasterizer.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

ViewPlan plan_for(const std::vector<Vec3>& points, const ViewPlanOptions& options = {}) {
  CpuRasterizer rasterizer;
  return plan_views(rasterizer, points, closed_sheet_pixel_size(estimate_spacing(points)), options);
}

std::vector<Vec3> points_on(const TriangleSoup& soup, std::size_t count = 40'000) {
  return shapes::to_points(shapes::sampled(soup, count));
}

}  // namespace

TEST_CASE("plan_views see a convex body whole with few views") {
  // Seen within 70 degrees, a cap of (1 - cos 70) / 2 = 33 % of a sphere belongs to each view: four
  // could do it at best, six along the axes surely do (no direction is farther than 55 degrees
  // from one). Two opposite diagonals see all faces of a cube.
  const TriangleSoup cube = shapes::moved(shapes::cube(), shapes::tilt());
  for (const auto& [soup, fewest] :
       {std::pair{shapes::sphere(), std::size_t{4}}, std::pair{cube, std::size_t{2}}}) {
    const ViewPlan plan = plan_for(points_on(soup));
    CHECK(plan.directions.size() >= fewest);
    CHECK(plan.directions.size() <= 8);
    REQUIRE(plan.coverage.size() == plan.directions.size());
    CHECK(plan.coverage.back() > 0.995);
    CHECK(plan.reachable >= plan.coverage.back());
    for (const Vec3& direction : plan.directions)
      CHECK(glm::length(direction) == Approx(1.0));
  }
}

TEST_CASE("plan_views never lose coverage from view to view") {
  for (const TriangleSoup& soup : {shapes::trefoil(), shapes::pocket(0.6), shapes::torus()}) {
    const ViewPlan plan = plan_for(points_on(soup));
    CHECK(std::is_sorted(plan.coverage.begin(), plan.coverage.end()));
    CHECK(plan.coverage.back() <= plan.reachable);
    CHECK(plan.coverage.back() > plan.reachable - 0.01);
  }
}

TEST_CASE("plan_views do not see a sheet behind another one") {
  // Of two concentric spheres the inner one, half as large, is a fifth of the area.
  const TriangleSoup inner = shapes::sphere(0.5);
  const ViewPlan plan = plan_for(points_on(shapes::merged(shapes::sphere(1.0), inner), 60'000));
  CHECK(plan.reachable < 0.8 + 0.005);
  CHECK(plan.coverage.back() > 0.79);
}

TEST_CASE("plan_views look into a pocket from where its floor is seen") {
  // Pocket of depth 0.6 and width 0.6: half of the floor's width is seen within 27 degrees.
  const ViewPlan plan = plan_for(points_on(shapes::pocket(0.6)));
  CHECK(std::any_of(plan.directions.begin(), plan.directions.end(),
                    [](const Vec3& direction) { return direction.z > 0.89; }));
}

TEST_CASE("plan_views of an open sheet begin above it, even where it looks better from below") {
  // Seen from above, a rough canopy hides a fifth of the flat ground; from below it is the canopy
  // that is hidden.
  const std::uint64_t seed = GENERATE(1U, 2U, 3U);
  CAPTURE(seed);
  shapes::Random random(seed);
  std::vector<Vec3> points;
  for (int i = 0; i < 40'000; ++i)
    points.push_back({random.between(-1.0, 1.0), random.between(-1.0, 1.0), 0.0});
  for (int i = 0; i < 8'000; ++i) {
    const double x = random.between(-0.2, 0.2);
    points.push_back({x, random.between(-1.0, 1.0), 0.2 + 0.1 * random.unit()});
  }
  REQUIRE(plan_for(points).directions.front().z < 0.0);
  const ViewPlan plan = plan_for(points, {.one_sided = true});
  CHECK(plan.directions.front().z > 0.9);
  for (const Vec3& direction : plan.directions)
    CHECK(glm::dot(direction, plan.directions.front()) > 0.0);
}

TEST_CASE("plan_views_of look at their targets only, past what hides them") {
  // The floor of a pocket is seen from above, within 30 degrees; the axes are among the candidates.
  const std::vector<Vec3> points = points_on(shapes::pocket(1.0));
  const auto is_in_middle = [](const Vec3& p) {
    return std::max(std::abs(p.x), std::abs(p.y)) < 0.2;
  };
  double bottom = 1.0;  // of the body, below the floor
  for (const Vec3& p : points)
    bottom = std::min(bottom, p.z);
  std::vector<Vec3> floor;
  for (const Vec3& p : points) {
    if (is_in_middle(p) && p.z > bottom + 0.01) floor.push_back(p);
  }
  REQUIRE(floor.size() > 20);
  CpuRasterizer rasterizer;
  const double side = closed_sheet_pixel_size(estimate_spacing(points));
  const ViewPlan plan =
      plan_views_of(rasterizer, points, floor, side, {.coverage = 1.0, .views_for_quality = 0});
  REQUIRE(!plan.directions.empty());
  CHECK(plan.directions.size() <= 3);
  for (const Vec3& direction : plan.directions)
    CHECK(direction.z > 0.8);
  CHECK(plan.coverage.back() > 0.95);
  CHECK_THROWS_AS(plan_views_of(rasterizer, points, {}, side), InvalidArgument);
}

TEST_CASE("plan_views cover as much when the axes of the cloud are exchanged") {
  const std::vector<Vec3> points = points_on(shapes::moved(shapes::torus(), shapes::tilt()));
  std::vector<Vec3> exchanged;
  for (const Vec3& p : points)
    exchanged.emplace_back(p.y, p.z, p.x);
  const ViewPlan a = plan_for(points);
  const ViewPlan b = plan_for(exchanged);
  // The candidates turn against the cloud by less than 15 degrees, the distance of two of them.
  CHECK(a.coverage.back() == Approx(b.coverage.back()).margin(0.005));
  CHECK(a.reachable == Approx(b.reachable).margin(0.002));
}

TEST_CASE("plan_views move with the cloud") {
  const std::vector<Vec3> points = points_on(shapes::torus());
  std::vector<Vec3> far = points;
  for (Vec3& p : far)
    p += Vec3(4096.0, -8192.0, 1024.0);  // exact for float coordinates of 2^-24
  CHECK(plan_for(points).coverage.back() == Approx(plan_for(far).coverage.back()).margin(0.002));
}

TEST_CASE("plan_views ignore far outliers") {
  std::vector<Vec3> points = points_on(shapes::sphere());
  shapes::Random random(3);
  for (int i = 0; i < 200; ++i) {
    const double length = random.between(50, 500);
    points.push_back(length * random.direction());
  }
  const ViewPlan plan = plan_for(points);
  CHECK(plan.coverage.back() > 0.995);
  CHECK(plan.directions.size() <= 8);
}

TEST_CASE("plan_views are the same for any number of threads") {
  const std::vector<Vec3> points = points_on(shapes::trefoil());
  std::vector<ViewPlan> plans;
  for (const int threads : {1, 2, 5}) {
    run_with_threads(threads, [&] { plans.push_back(plan_for(points)); });
  }
  for (const ViewPlan& plan : plans) {
    CHECK(plan.directions == plans.front().directions);
    CHECK(plan.coverage == plans.front().coverage);
  }
}

TEST_CASE("plan_views keep their limits") {
  const std::vector<Vec3> points = points_on(shapes::trefoil());
  CHECK(plan_for(points, {.max_views = 3}).directions.size() == 3);
  const ViewPlan half = plan_for(points, {.coverage = 0.5});
  CHECK(half.coverage.back() >= 0.5);
  CHECK((half.coverage.size() < 2 || half.coverage[half.coverage.size() - 2] < 0.5));

  const std::vector<Vec3> one{{1.0, 2.0, 3.0}};
  CpuRasterizer rasterizer;
  CHECK(plan_views(rasterizer, one, 0.1).directions.size() <= 1);
}

TEST_CASE("plan_views refuse what they cannot plan") {
  CpuRasterizer rasterizer;
  const std::vector<Vec3> points = points_on(shapes::sphere(), 500);
  CHECK_THROWS_AS(plan_views(rasterizer, {}, 0.1), InvalidArgument);
  CHECK_THROWS_AS(plan_views(rasterizer, points, 0.0), InvalidArgument);
  CHECK_THROWS_AS(plan_views(rasterizer, points, -1.0), InvalidArgument);
  CHECK_THROWS_AS(plan_views(rasterizer, points, std::nan("")), InvalidArgument);
  CHECK_THROWS_AS(plan_views(rasterizer, points, 0.1, {.max_views = 0}), InvalidArgument);
  CHECK_THROWS_AS(plan_views(rasterizer, points, 0.1, {.candidates = 0}), InvalidArgument);
  CHECK_THROWS_AS(plan_views(rasterizer, points, 0.1, {.subset = 0}), InvalidArgument);
  CHECK_THROWS_AS(plan_views(rasterizer, points, 0.1, {.max_slope_cosine = 1.0}), InvalidArgument);

  std::stop_source stop;
  stop.request_stop();
  CHECK_THROWS_AS(plan_views(rasterizer, points, 0.1, {}, {.stop = stop.get_token()}), Cancelled);
}

}  // namespace rangezip
