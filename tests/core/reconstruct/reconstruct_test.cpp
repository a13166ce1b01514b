// Whole runs on bodies whose right answer is known.
#include "core/reconstruct/reconstruct.h"

#include <catch2/catch.hpp>

#include "core/base/error.h"
#include "core/session/session.h"
#include "raster_cpu/cpu_rasterizer.h"
#include "tests/support/shapes.h"

using namespace rangezip;

namespace {

Scene scene_of(PointCloud cloud, const Mat4& placement = Mat4{1.0}) {
  Scene scene;
  scene.add(std::make_shared<const PointCloud>(std::move(cloud)), placement);
  return scene;
}

Scene scene_of(TriangleSoup soup) {
  Scene scene;
  scene.add(std::make_shared<const TriangleSoup>(std::move(soup)));
  return scene;
}

ReconstructResult run(const Scene& scene, const ReconstructOptions& options = {}) {
  CpuRasterizer rasterizer;
  return reconstruct(scene, rasterizer, options);
}

/// What holds for every result: oriented, manifold, free of self-intersections.
void check_clean(const ReconstructResult& result) {
  CHECK_NOTHROW(check_mesh(result.mesh));
  CHECK(result.report.mesh.is_manifold());
  CHECK(result.report.self_intersections == 0);
}

/// Largest distance of a vertex from the unit sphere.
double distance_from_unit_sphere(const TriangleMesh& mesh) {
  double worst = 0.0;
  for (const Vec3& p : mesh.positions)
    worst = std::max(worst, std::abs(glm::length(p) - 1.0));
  return worst;
}

double signed_volume(const TriangleMesh& mesh) {
  double six_volumes = 0.0;
  for (const Triangle& t : mesh.triangles) {
    six_volumes +=
        glm::dot(mesh.positions[t[0]], glm::cross(mesh.positions[t[1]], mesh.positions[t[2]]));
  }
  return six_volumes / 6.0;
}

constexpr double kPi = std::numbers::pi;

/// A plate of 2 x 2 with rows of square holes through it; closed, genus holes_a_row^2.
TriangleSoup drilled_plate(int holes_a_row, double hole, double thickness) {
  // Cells between these lines, in x and in y; those with two odd numbers are holes.
  std::vector<double> lines{-1.0};
  for (int i = 0; i < holes_a_row; ++i) {
    const double middle = (2 * i + 1.0) / holes_a_row - 1.0;
    lines.insert(lines.end(), {middle - 0.5 * hole, middle + 0.5 * hole});
  }
  lines.push_back(1.0);
  const auto cells = static_cast<int>(lines.size()) - 1;
  const auto is_full = [&](int x, int y) {
    return x >= 0 && y >= 0 && x < cells && y < cells && (x % 2 == 0 || y % 2 == 0);
  };
  TriangleSoup soup;
  const auto place = [&](int x, int y, double z) {
    soup.positions.emplace_back(lines[static_cast<std::size_t>(x)],
                                lines[static_cast<std::size_t>(y)], z);
    return static_cast<std::uint32_t>(soup.positions.size() - 1);
  };
  const auto add = [&](int ax, int ay, double az, int bx, int by, double bz, int cx, int cy,
                       double cz, int dx, int dy, double dz) {
    const std::uint32_t a = place(ax, ay, az), b = place(bx, by, bz), c = place(cx, cy, cz);
    shapes::add_quad(soup, a, b, c, place(dx, dy, dz));
  };
  const auto add_wall = [&](int ax, int ay, int bx, int by) {  // outside to the right of a -> b
    add(ax, ay, 0.0, bx, by, 0.0, bx, by, thickness, ax, ay, thickness);
  };
  for (int y = 0; y < cells; ++y) {
    for (int x = 0; x < cells; ++x) {
      if (!is_full(x, y)) continue;
      add(x, y, thickness, x + 1, y, thickness, x + 1, y + 1, thickness, x, y + 1, thickness);
      add(x, y, 0.0, x, y + 1, 0.0, x + 1, y + 1, 0.0, x + 1, y, 0.0);
      if (!is_full(x, y - 1)) add_wall(x, y, x + 1, y);
      if (!is_full(x + 1, y)) add_wall(x + 1, y, x + 1, y + 1);
      if (!is_full(x, y + 1)) add_wall(x + 1, y + 1, x, y + 1);
      if (!is_full(x - 1, y)) add_wall(x, y + 1, x, y);
    }
  }
  return soup;
}

}  // namespace

TEST_CASE("a sampled sphere becomes one closed sphere, outside out", "[reconstruct]") {
  const ReconstructResult result = run(scene_of(shapes::sampled(shapes::sphere(), 30'000)));
  check_clean(result);
  CHECK(result.report.mesh.components == 1);
  CHECK(result.report.mesh.boundary_edges == 0);
  CHECK(result.report.mesh.euler == 2);
  CHECK(result.report.coverage.share > 0.999);
  // No vertex leaves the sheet of its pixel: where random points leave a gap of a pixel, a fit is
  // an extrapolation, but never by more than a pixel side.
  CHECK(distance_from_unit_sphere(result.mesh) < 1.0 * result.report.pixel_size);
  CHECK(signed_volume(result.mesh) == Approx(4.0 / 3.0 * kPi).epsilon(0.01));
}

TEST_CASE("a sampled torus keeps its hole", "[reconstruct]") {
  const ReconstructResult result = run(scene_of(shapes::sampled(shapes::torus(), 40'000)));
  check_clean(result);
  CHECK(result.report.mesh.components == 1);
  CHECK(result.report.mesh.boundary_edges == 0);
  CHECK(result.report.mesh.euler == 0);
  CHECK(signed_volume(result.mesh) == Approx(2.0 * kPi * kPi * 0.16).epsilon(0.01));
}

TEST_CASE("a torus of contours is closed between them and keeps its hole", "[reconstruct]") {
  // Slices 0.06 apart, and 0.22 at most on the surface, where it is level; a point in every 0.01.
  const ReconstructResult result =
      run(scene_of(shapes::sliced_torus(1.0, 0.4, 0.06, 0.01), shapes::tilt()));
  check_clean(result);
  CHECK(result.report.mesh.components == 1);
  CHECK(result.report.mesh.boundary_edges == 0);
  CHECK(result.report.mesh.euler == 0);
  CHECK(signed_volume(result.mesh) == Approx(2.0 * kPi * kPi * 0.16).epsilon(0.01));
}

TEST_CASE("two bodies far apart become two closed components", "[reconstruct]") {
  const ReconstructResult result = run(scene_of(shapes::sampled(shapes::two_spheres(1.0), 40'000)));
  check_clean(result);
  CHECK(result.report.mesh.components == 2);
  CHECK(result.report.mesh.boundary_edges == 0);
  CHECK(result.report.mesh.euler == 4);
}

TEST_CASE("a hilly terrain becomes one open sheet that faces up", "[reconstruct]") {
  PointCloud cloud;
  shapes::Random random(5);
  for (int i = 0; i < 30'000; ++i) {
    const double x = random.between(-1.0, 1.0);
    const double y = random.between(-1.0, 1.0);
    cloud.positions.emplace_back(x, y, 0.15 * std::sin(4.0 * x) * std::cos(3.0 * y));
  }
  const ReconstructResult result = run(scene_of(std::move(cloud)));
  check_clean(result);
  CHECK(result.report.mesh.components == 1);
  CHECK(result.report.mesh.boundary_loops == 1);
  CHECK(result.report.mesh.euler == 1);
  CHECK(result.report.coverage.share > 0.99);
  for (const Triangle& t : result.mesh.triangles) {
    REQUIRE(area_vector(result.mesh.positions[t[0]], result.mesh.positions[t[1]],
                        result.mesh.positions[t[2]])
                .z > 0.0);
  }
}

TEST_CASE("small things over a terrain stay, each by itself", "[reconstruct]") {
  // Five boards of 5 pixels a side, about 50 faces, that hang over it.
  PointCloud cloud;
  shapes::Random random(6);
  constexpr double kBoard = 0.1;
  for (int i = 0; i < 30'000; ++i)
    cloud.positions.emplace_back(random.between(-1.0, 1.0), random.between(-1.0, 1.0), 0.0);
  for (const auto& [x, y] :
       {std::pair{0.0, 0.0}, {0.6, 0.5}, {-0.6, 0.5}, {0.5, -0.6}, {-0.5, -0.6}}) {
    for (int i = 0; i < 75; ++i) {
      cloud.positions.emplace_back(x + random.between(0.0, kBoard), y + random.between(0.0, kBoard),
                                   0.3);
    }
  }
  const ReconstructResult result = run(scene_of(std::move(cloud)));
  check_clean(result);
  CHECK(result.report.mesh.components == 6);
  CHECK(result.report.mesh.boundary_loops == 6);
  CHECK(result.report.coverage.share > 0.999);
}

TEST_CASE("views of what is left out keep holes through a plate open", "[reconstruct]") {
  // Holes of six pixels, six deep, with a small part of the points on their walls. Of the 48 of
  // three clouds 17 are kept by views of the whole plate.
  std::ptrdiff_t kept = 0;
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const ReconstructResult result =
        run(scene_of(shapes::sampled(drilled_plate(4, 0.1, 0.1), 60'000, seed), shapes::tilt()));
    check_clean(result);
    CHECK(result.report.mesh.components == 1);
    const auto loops = static_cast<std::ptrdiff_t>(result.report.mesh.boundary_loops);
    kept += (2 - result.report.mesh.euler - loops) / 2;
  }
  CHECK(kept >= 22);
  CHECK(kept <= 48);
}

TEST_CASE("sparse points keep holes open that are hardly wider than two pixels", "[reconstruct]") {
  // Holes of 2.4 pixels, 3.5 deep. Of the 48 of three clouds 23 are kept where half pixels are to
  // show them.
  std::ptrdiff_t kept = 0;
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const ReconstructResult result =
        run(scene_of(shapes::sampled(drilled_plate(4, 0.09, 0.13), 10'000, seed), shapes::tilt()));
    check_clean(result);
    CHECK(result.report.pixel_size > 0.09 / 2.5);
    CHECK(result.report.mesh.components == 1);
    CHECK(result.report.mesh.boundary_loops == 0);
    kept += (2 - result.report.mesh.euler) / 2;
  }
  CHECK(kept >= 46);
  CHECK(kept <= 48);
}

TEST_CASE("sparse points of a wall as thin as a pixel are meshed, all of them", "[reconstruct]") {
  // All of it looks like papered holes: of what fronts are to grow over hardly anything may go.
  const ReconstructResult result =
      run(scene_of(shapes::sampled(shapes::plate(0.045), 10'000), shapes::tilt()));
  check_clean(result);
  CHECK(result.report.pixel_size < 0.045);
  CHECK(result.report.coverage.share > 0.97);
}

TEST_CASE("what polygons have inside leaves no trace on their surface", "[reconstruct]") {
  constexpr double kPixel = 0.05;
  Scene scene = scene_of(shapes::sphere());
  scene.add(std::make_shared<const TriangleSoup>(shapes::sphere(1.0 - 0.7 * kPixel)));
  ReconstructOptions options;
  options.pixel_size = kPixel;
  const ReconstructResult result = run(scene, options);
  check_clean(result);
  CHECK(result.report.mesh.components == 1);
  CHECK(result.report.mesh.euler == 2);
  CHECK(distance_from_unit_sphere(result.mesh) < 0.1 * kPixel);
}

TEST_CASE("the walls of a cavity behind a narrow mouth are meshed, given as polygons",
          "[reconstruct]") {
  constexpr double kPixel = 0.05, kMouth = 0.075, kInner = 0.6;  // radius of the mouth: 1.5 pixels
  std::vector<Vec2> profile = shapes::arc(1.0, 0.0, kPi - std::asin(kMouth), 48);
  const std::vector<Vec2> inner = shapes::arc(kInner, kPi - std::asin(kMouth / kInner), 0.0, 48);
  profile.insert(profile.end(), inner.begin(), inner.end());
  ReconstructOptions options;
  options.pixel_size = kPixel;
  const ReconstructResult result = run(scene_of(shapes::revolved(profile, false)), options);
  check_clean(result);
  CHECK(result.report.mesh.boundary_edges == 0);
  CHECK(result.report.mesh.euler == 2);
  CHECK(result.report.coverage.share > 0.999);
  const double whole = 4.0 / 3.0 * kPi;
  CHECK(signed_volume(result.mesh) == Approx(whole * (1.0 - std::pow(kInner, 3))).epsilon(0.02));
}

TEST_CASE("polygons are scanned as they are: a washer stays closed, of genus 1 and exact",
          "[reconstruct]") {
  const ReconstructResult result =
      run(scene_of(shapes::moved(shapes::washer(), shapes::tilt())), {.triangles = 30'000});
  check_clean(result);
  CHECK(result.report.mesh.components == 1);
  CHECK(result.report.mesh.boundary_edges == 0);
  CHECK(result.report.mesh.euler == 0);
  // 96 segments: the polygon's area, not the circle's.
  const double segment = std::sin(2.0 * kPi / 96) * 96 / 2;
  CHECK(signed_volume(result.mesh) == Approx(0.5 * segment * (1.0 - 0.16)).epsilon(0.005));
}

TEST_CASE("the mesh does not depend on the number of threads", "[reconstruct]") {
  const Scene scene = scene_of(shapes::sampled(shapes::torus(), 15'000));
  const ReconstructResult one = run(scene, {.threads = 1});
  const ReconstructResult two = run(scene, {.threads = 2});
  const ReconstructResult five = run(scene, {.threads = 5});
  CHECK(one.mesh == two.mesh);
  CHECK(one.mesh == five.mesh);
}

TEST_CASE("replaying the recorded commands gives the same mesh", "[reconstruct]") {
  const Scene scene = scene_of(shapes::sampled(shapes::sphere(), 10'000));
  const ReconstructResult result = run(scene);
  CpuRasterizer rasterizer;
  Session session(scene);
  for (const Command& command : result.commands)
    session.apply(command, rasterizer);
  CHECK(*session.mesh() == result.mesh);
}

TEST_CASE("a cloud far from the origin gives the moved mesh", "[reconstruct]") {
  const PointCloud cloud = shapes::sampled(shapes::torus(), 15'000);
  const Vec3 offset{636'763.0, 851'298.0, 415.0};
  const ReconstructResult here = run(scene_of(cloud));
  const ReconstructResult there = run(scene_of(cloud, shapes::translation(offset)));
  REQUIRE(here.mesh.triangles == there.mesh.triangles);
  const double size = bounds_of(here.mesh).diagonal();
  for (std::size_t i = 0; i < here.mesh.positions.size(); ++i) {
    REQUIRE(glm::length(here.mesh.positions[i] + offset - there.mesh.positions[i]) < 1e-6 * size);
  }
}

TEST_CASE("the paper's own method closes a sphere as well", "[reconstruct]") {
  const ReconstructResult result = run(scene_of(shapes::sampled(shapes::sphere(), 30'000)),
                                       {.method = ReconstructMethod::paper});
  check_clean(result);
  CHECK(result.report.mesh.components == 1);
  CHECK(result.report.coverage.share > 0.99);
  // The nearest sample of a pixel lies up to a pixel side in front of the surface.
  CHECK(distance_from_unit_sphere(result.mesh) < 1.5 * result.report.pixel_size);
}

TEST_CASE("a number of triangles is met within 5 %, whatever the finish and the shape",
          "[reconstruct]") {
  // How a cube lies to the views that win decides how many pixels it has, not its area alone.
  const TriangleSoup shape = GENERATE(shapes::sphere(), shapes::cube());
  const std::optional<FinishMethod> finish = GENERATE(
      as<std::optional<FinishMethod>>{}, std::nullopt, FinishMethod::fast, FinishMethod::full);
  const Scene scene = scene_of(shapes::sampled(shapes::moved(shape, shapes::tilt()), 60'000));
  const std::size_t triangles = GENERATE(as<std::size_t>{}, 4'000, 12'000);
  CAPTURE(triangles, finish.has_value());
  CpuRasterizer rasterizer;
  double last = 0.0;
  const Progress progress{.report = [&](std::string_view, double share) {
    CHECK(share >= last - 1e-12);
    last = share;
  }};
  const ReconstructResult result =
      reconstruct(scene, rasterizer, {.triangles = triangles, .finish = finish}, progress);
  CHECK(static_cast<double>(result.report.mesh.faces) ==
        Approx(static_cast<double>(triangles)).epsilon(0.05));
  CHECK(last == Approx(1.0));
}

TEST_CASE("more triangles than the points can tell are refused with the largest number",
          "[reconstruct]") {
  const Scene scene = scene_of(shapes::sampled(shapes::sphere(), 2'000));
  CHECK_THROWS_WITH(run(scene, {.triangles = 1'000'000}),
                    Catch::Contains("triangles may be at most"));
}

TEST_CASE("reconstruct refuses what cannot be meshed", "[reconstruct]") {
  CHECK_THROWS_AS(run(Scene{}), InvalidArgument);
  const Scene scene = scene_of(shapes::sampled(shapes::sphere(), 2'000));
  CHECK_THROWS_AS(run(scene, {.pixel_size = 0.0}), InvalidArgument);
  CHECK_THROWS_AS(run(scene, {.triangles = 0}), InvalidArgument);
  CHECK_THROWS_AS(run(scene, {.views = 0}), InvalidArgument);
  CHECK_THROWS_AS(run(scene, {.threads = -1}), InvalidArgument);
  CHECK_THROWS_AS(run(scene, {.decimate = -0.1}), InvalidArgument);
  CHECK_THROWS_AS(run(scene, {.close_holes = -1.0}), InvalidArgument);
  const PointCloud two{.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, 0}}};
  CHECK_THROWS_AS(run(scene_of(two)), InvalidArgument);
}

TEST_CASE("a run can be cancelled and says how far it is", "[reconstruct]") {
  const Scene scene = scene_of(shapes::sampled(shapes::sphere(), 5'000));
  CpuRasterizer rasterizer;
  std::stop_source source;
  double last = 0.0;
  const Progress progress{.report =
                              [&](std::string_view, double share) {
                                CHECK(share >= last - 1e-12);
                                last = share;
                                if (share > 0.2) source.request_stop();
                              },
                          .stop = source.get_token()};
  CHECK_THROWS_AS(reconstruct(scene, rasterizer, {}, progress), Cancelled);
  CHECK(last < 0.6);
}

namespace {

/// How far a sphere with waves on its cap is from its centre in a direction of this height.
double wavy_radius(double z) {
  return 1.0 + 0.01 * std::clamp(10.0 * (z - 0.6), 0.0, 1.0) * std::cos(60.0 * z);
}

/// Points of that sphere, 16 times as dense where it has waves.
PointCloud wavy_sphere(std::uint64_t seed) {
  shapes::Random random(seed);
  PointCloud cloud;
  for (int i = 0; i < 320'000; ++i) {
    const Vec3 direction = random.direction();
    if (direction.z > 0.55 || random.unit() < 1.0 / 16.0)
      cloud.positions.emplace_back(wavy_radius(direction.z) * direction);
  }
  return cloud;
}

double mean_edge(const TriangleMesh& mesh, double lowest_z, double highest_z) {
  double sum = 0.0;
  int count = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]];
    if (a.z < lowest_z || a.z > highest_z) continue;
    sum += glm::distance(a, b);
    ++count;
  }
  return sum / count;
}

}  // namespace

TEST_CASE("where a cloud is 16 times as dense, the mesh shows what only these points tell") {
  const ReconstructResult result = run(scene_of(wavy_sphere(1)));
  check_clean(result);
  CHECK(result.report.mesh.boundary_loops == 0);
  CHECK(result.report.mesh.euler == 2);
  // The waves are three pixels of the other scans long: these show hardly anything of them.
  const double h = result.report.pixel_size;
  CHECK(h > 0.03);
  CHECK(mean_edge(result.mesh, 0.75, 1.0) < 0.5 * mean_edge(result.mesh, -1.0, 0.4));
  double squares = 0.0;
  int count = 0;
  for (const Vec3& p : result.mesh.positions) {
    if (p.z < 0.75) continue;
    const double off = glm::length(p) - wavy_radius(p.z / glm::length(p));
    squares += off * off;
    ++count;
  }
  CHECK(std::sqrt(squares / count) < 0.1 * 0.01);
}

TEST_CASE("an uneven cloud loses nothing of its sparse part for the sake of many triangles") {
  const std::size_t wanted = GENERATE(20'000U, 150'000U);
  CAPTURE(wanted);
  const ReconstructResult result = run(scene_of(wavy_sphere(2)), {.triangles = wanted});
  check_clean(result);
  CHECK(result.report.mesh.boundary_loops == 0);
  CHECK(static_cast<double>(result.mesh.triangles.size()) ==
        Approx(static_cast<double>(wanted)).epsilon(0.05));
}

TEST_CASE("an uneven cloud gives the triangles asked for where its own pixels are too coarse") {
  const auto [wanted, finish] = GENERATE(table<std::size_t, FinishMethod>(
      {{600'000, FinishMethod::full},    // more than the finish splits its faces into
       {60'000, FinishMethod::fast}}));  // which splits no face
  CAPTURE(wanted);
  const ReconstructResult result =
      run(scene_of(wavy_sphere(2)), {.triangles = wanted, .finish = finish});
  check_clean(result);
  CHECK(static_cast<double>(result.mesh.triangles.size()) ==
        Approx(static_cast<double>(wanted)).epsilon(0.05));
}
