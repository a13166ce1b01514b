#include "core/plan/visibility_vote.h"

#include <catch2/catch.hpp>
#include <numbers>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/plan/spacing.h"
#include "raster_cpu/cpu_rasterizer.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

constexpr std::size_t kCount = 40'000;

struct Voted {
  std::vector<Vec3> points;
  VisibilityVotes votes;
};

Voted vote_on(const TriangleSoup& soup, std::size_t count = kCount) {
  auto cloud = std::make_shared<PointCloud>(shapes::sampled(soup, count));
  Scene scene;
  scene.add(cloud);
  CpuRasterizer rasterizer;
  const double h = closed_sheet_pixel_size(estimate_spacing(scene.points()));
  return {scene.points(), visibility_votes(rasterizer, scene, h)};
}

Vec3 vector_of(const std::array<std::int8_t, 3>& vote) {
  return {vote[0], vote[1], vote[2]};
}

/// Share of the votes that look along the outward normal.
template <class Normal>
double outward_share(const Voted& voted, const Normal& normal_at) {
  std::size_t outward = 0;
  for (std::size_t i = 0; i < voted.points.size(); ++i) {
    outward += glm::dot(vector_of(voted.votes[i]), normal_at(voted.points[i])) > 0.0 ? 1 : 0;
  }
  return static_cast<double>(outward) / static_cast<double>(voted.points.size());
}

}  // namespace

TEST_CASE("visibility_votes point outward on a sphere, at full length") {
  const Voted voted = vote_on(shapes::sphere());
  REQUIRE(voted.votes.size() == kCount);
  CHECK(outward_share(voted, [](const Vec3& p) { return p; }) > 0.9999);
  double mean_cosine = 0.0;
  double mean_length = 0.0;
  for (std::size_t i = 0; i < kCount; ++i) {
    const Vec3 vote = vector_of(voted.votes[i]);
    REQUIRE(glm::length(vote) <= 128.0);
    mean_length += glm::length(vote) / kCount;
    mean_cosine += glm::dot(glm::normalize(vote), glm::normalize(voted.points[i])) / kCount;
  }
  CHECK(mean_cosine > 0.98);
  CHECK(mean_length > 100.0);
  CHECK(mean_length <= 127.5);
}

TEST_CASE("visibility_votes point outward on a torus") {
  const Voted voted = vote_on(shapes::torus());
  CHECK(outward_share(voted, [](const Vec3& p) {
          const Vec3 on_ring = glm::normalize(Vec3(p.x, p.y, 0.0));
          return p - on_ring;
        }) > 0.999);
}

TEST_CASE("visibility_votes tell both sides of a plate apart") {
  // The plate is five pixels thick.
  const Voted voted = vote_on(shapes::plate(0.2));
  std::size_t right = 0;
  std::size_t inner = 0;
  for (std::size_t i = 0; i < kCount; ++i) {
    const Vec3& p = voted.points[i];
    if (std::max(std::abs(p.x), std::abs(p.y)) > 0.95) continue;
    ++inner;
    right += voted.votes[i][2] * (p.z > 0.0 ? 1 : -1) > 0 ? 1 : 0;
  }
  CHECK(static_cast<double>(right) > 0.999 * static_cast<double>(inner));
}

TEST_CASE("visibility_votes give none to what nobody sees") {
  const TriangleSoup soup = shapes::merged(shapes::sphere(1.0), shapes::sphere(0.5));
  const Voted voted = vote_on(soup, 60'000);
  std::size_t inner = 0;
  std::size_t silent = 0;
  for (std::size_t i = 0; i < voted.points.size(); ++i) {
    if (glm::length(voted.points[i]) > 0.75) continue;
    ++inner;
    silent += glm::length(vector_of(voted.votes[i])) < 13.0 ? 1 : 0;  // a tenth
  }
  REQUIRE(inner > 10'000);
  CHECK(static_cast<double>(silent) > 0.99 * static_cast<double>(inner));
}

TEST_CASE("visibility_votes let polygons hide points") {
  auto inner = std::make_shared<PointCloud>(shapes::sampled(shapes::sphere(0.5), 5000));
  Scene scene;
  scene.add(inner);
  scene.add(std::make_shared<TriangleSoup>(shapes::cube()));
  CpuRasterizer rasterizer;
  const VisibilityVotes votes = visibility_votes(rasterizer, scene, 0.05);
  REQUIRE(votes.size() == 5000);
  for (const auto& vote : votes)
    REQUIRE(vote == std::array<std::int8_t, 3>{0, 0, 0});
}

TEST_CASE("visibility_votes follow the order of the scene's clouds and their placement") {
  auto cloud = std::make_shared<PointCloud>(shapes::sampled(shapes::sphere(), 5000));
  Scene both;
  both.add(cloud, shapes::translation({-1.5, 0.0, 0.0}));
  both.add(std::make_shared<TriangleSoup>(shapes::box({-9, -9, -3}, {9, 9, -2})));
  both.add(cloud, shapes::translation({1.5, 0.0, 0.0}));
  CpuRasterizer rasterizer;
  const VisibilityVotes votes = visibility_votes(rasterizer, both, 0.08);
  REQUIRE(votes.size() == 10'000);
  std::size_t outward = 0;
  for (std::size_t i = 0; i < votes.size(); ++i) {
    outward += glm::dot(vector_of(votes[i]), Vec3(cloud->positions[i % 5000])) > 0.0 ? 1 : 0;
  }
  // From below the slab hides them, and the neighbour hides some of each side.
  CHECK(outward > 9'000);
}

TEST_CASE("visibility_votes are the same for any number of threads") {
  Scene scene;
  scene.add(std::make_shared<PointCloud>(shapes::sampled(shapes::trefoil(), 100'000)));
  std::vector<VisibilityVotes> votes;
  for (const int threads : {1, 2, 5}) {
    run_with_threads(threads, [&] {
      CpuRasterizer rasterizer;
      votes.push_back(visibility_votes(rasterizer, scene, 0.05));
    });
  }
  CHECK(votes[0] == votes[1]);
  CHECK(votes[0] == votes[2]);
}

TEST_CASE("visibility_votes refuse bad arguments and have nothing to say on polygons alone") {
  CpuRasterizer rasterizer;
  Scene scene;
  CHECK(visibility_votes(rasterizer, scene, 1.0).empty());
  scene.add(std::make_shared<TriangleSoup>(shapes::cube()));
  CHECK(visibility_votes(rasterizer, scene, 1.0).empty());
  scene.add(std::make_shared<PointCloud>(shapes::sampled(shapes::cube(), 100)));
  CHECK_THROWS_AS(visibility_votes(rasterizer, scene, 0.0), InvalidArgument);
  CHECK_THROWS_AS(visibility_votes(rasterizer, scene, INFINITY), InvalidArgument);
  CHECK_THROWS_AS(visibility_votes(rasterizer, scene, 0.1, 0), InvalidArgument);
  CHECK_THROWS_AS(visibility_votes(rasterizer, scene, 0.1, kMaxVoteDirections + 1),
                  InvalidArgument);
  CHECK_THROWS_AS(votes_toward({}, Vec3(0.0)), InvalidArgument);
}

TEST_CASE("votes_toward is the component along the line of sight") {
  const VisibilityVotes votes{{127, 0, 0}, {0, -127, 0}, {90, 90, 0}, {0, 0, 0}, {-30, 0, 40}};
  CHECK(votes_toward(votes, {2.0, 0.0, 0.0}) == std::vector<std::int8_t>{127, 0, 90, 0, -30});
  CHECK(votes_toward(votes, {0.0, 1.0, 0.0}) == std::vector<std::int8_t>{0, -127, 90, 0, 0});
  // 180 / sqrt 2 = 127.3 is clamped; (-30 * 3 + 40 * 4) / 5 = 14
  CHECK(votes_toward(votes, {1.0, 1.0, 0.0})[2] == 127);
  CHECK(votes_toward(votes, {3.0, 0.0, 4.0})[4] == 14);
}

}  // namespace rangezip
