#include "core/finish/finish.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>

#include "core/base/parallel.h"
#include "core/finish/bridge_loops.h"
#include "core/mesh/coverage.h"
#include "core/mesh/mesh_report.h"
#include "core/mesh/self_intersection.h"
#include "tests/core/finish/shapes.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

using testing::uniform;

/// A sphere of about edge length h whose faces are torn: holes, a crack, and crumpled places.
TriangleMesh torn_sphere(int n, std::uint64_t seed) {
  TriangleMesh mesh = testing::sphere(n);
  std::mt19937_64 engine(seed);
  const double h = 2.0 / n;
  std::vector<Vec3> holes;
  for (int i = 0; i < 6; ++i) {
    holes.push_back(glm::normalize(
        Vec3{uniform(engine, -1, 1), uniform(engine, -1, 1), uniform(engine, -1, 1)}));
  }
  for (Vec3& p : mesh.positions) {
    if (glm::length(p - holes[0]) < 4.0 * h || glm::length(p - holes[1]) < 2.0 * h) {
      p += 2.0 * h * Vec3{uniform(engine, -1, 1), uniform(engine, -1, 1), uniform(engine, -1, 1)};
    }
  }
  testing::cut_where(mesh, [&](const Vec3& p) {
    if (std::abs(p.z) < 0.6 * h && p.x > 0.2) return true;
    for (std::size_t i = 2; i < holes.size(); ++i) {
      if (glm::length(p - holes[i]) < static_cast<double>(i) * h) return true;
    }
    return false;
  });
  return mesh;
}

std::vector<Vec3> sphere_points(std::size_t count, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::vector<Vec3> points;
  while (points.size() < count) {
    const Vec3 p{uniform(engine, -1, 1), uniform(engine, -1, 1), uniform(engine, -1, 1)};
    const double length = glm::length(p);
    if (length > 0.1 && length < 1.0) points.push_back(p / length);
  }
  return points;
}

FinishOptions options_for(int n, FinishMethod method) {
  FinishOptions options;
  options.method = method;
  options.pixel_size = 2.0 / n;
  return options;
}

void require_clean(const TriangleMesh& mesh) {
  const MeshReport report = report_mesh(mesh);
  REQUIRE(report.is_manifold());
  REQUIRE(report.degenerate_faces == 0);
  REQUIRE(report.vertices == mesh.positions.size());
  REQUIRE_NOTHROW(check_mesh(mesh));
  REQUIRE(self_intersections(mesh).empty());
}

TEST_CASE("of a mesh all of whose faces cross nothing is left") {
  const auto method = GENERATE(FinishMethod::fast, FinishMethod::full);
  TriangleMesh mesh;
  mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0.1, 0, 1}, {0, 0.5, 1}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  REQUIRE_FALSE(self_intersections(mesh).empty());
  const FinishResult result =
      finish(mesh, {mesh.positions}, {.method = method, .pixel_size = 0.1, .min_component = 0});
  REQUIRE(result.mesh.empty());
}

TEST_CASE("a torn and crumpled sphere becomes closed and free of self-intersections") {
  const std::uint64_t seed = GENERATE(1U, 2U, 3U, 4U, 5U);
  CAPTURE(seed);
  constexpr int kN = 32;
  const TriangleMesh torn = torn_sphere(kN, seed);
  REQUIRE_FALSE(self_intersections(torn).empty());
  const auto method = GENERATE(FinishMethod::fast, FinishMethod::full);
  const FinishResult result = finish(torn, {sphere_points(40000, seed)}, options_for(kN, method));
  require_clean(result.mesh);
  REQUIRE(report_mesh(result.mesh).euler == 2);
  REQUIRE(report_mesh(result.mesh).components == 1);
  REQUIRE(result.report.open_loops == 0);
  REQUIRE(result.report.self_intersections_cut > 0);
}

TEST_CASE("of a mesh in which nothing crosses, whether that is told makes no difference") {
  constexpr int kN = 32;
  TriangleMesh mesh = testing::sphere(kN);
  testing::cut_where(mesh, [](const Vec3& p) { return std::abs(p.z) < 0.08 && p.x > 0.2; });
  REQUIRE(self_intersections(mesh).empty());
  const std::vector<Vec3> points = sphere_points(40000, 7);
  FinishOptions options = options_for(kN, FinishMethod::full);
  options.regrow = GENERATE(true, false);
  const TriangleMesh checked = finish(mesh, {points}, options).mesh;
  options.is_clean = true;
  const TriangleMesh told = finish(mesh, {points}, options).mesh;
  CHECK(told == checked);
  require_clean(told);
}

TEST_CASE(
    "far fewer triangles than the scans give are nearer to the cloud than evenly sized ones") {
  constexpr int kN = 48;
  TriangleMesh ellipsoid = testing::sphere(kN);
  std::vector<Vec3> cloud = sphere_points(60000, 1);
  const Vec3 axes(1.0, 1.0, 4.0);
  for (std::vector<Vec3>* points : {&ellipsoid.positions, &cloud}) {
    for (Vec3& p : *points)
      p *= axes;
  }
  FinishOptions options = options_for(kN, FinishMethod::full);
  options.triangles = 1000;
  const FinishResult result = finish(ellipsoid, {cloud}, options);
  require_clean(result.mesh);
  REQUIRE(result.mesh.triangles.size() == Approx(1000.0).epsilon(0.02));
  REQUIRE(testing::smallest_angle(result.mesh) > 0.17);
  double sum = 0.0;  // of squared distances, of the faces' middles, as those of the unit sphere
  for (const Triangle& t : result.mesh.triangles) {
    const auto& p = result.mesh.positions;
    const Vec3 middle = (p[t[0]] + p[t[1]] + p[t[2]]) / (3.0 * axes);
    sum += (glm::length(middle) - 1.0) * (glm::length(middle) - 1.0);
  }
  // Of equilateral ones of the same number, with corners on the surface, 0.009.
  REQUIRE(std::sqrt(sum / 1000.0) < 0.0025);
}

TEST_CASE("with a tolerance a cube keeps its edges with far fewer triangles") {
  constexpr int kN = 40;
  std::mt19937_64 engine(1);
  std::vector<Vec3> cloud(60000);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    cloud[i] = {uniform(engine, -1, 1), uniform(engine, -1, 1), uniform(engine, -1, 1)};
    cloud[i][static_cast<int>(i % 3)] = i % 2 == 0 ? 1.0 : -1.0;
  }
  FinishOptions options = options_for(kN, FinishMethod::full);
  const FinishResult whole = finish(testing::cube(kN), {cloud}, options);
  options.flat_tolerance = 0.01;
  const FinishResult result = finish(testing::cube(kN), {cloud}, options);
  require_clean(result.mesh);
  REQUIRE(5 * result.mesh.triangles.size() < whole.mesh.triangles.size());
  REQUIRE(testing::volume_of(result.mesh) == Approx(8.0).epsilon(1e-4));
}

TEST_CASE("a second finish changes nothing that the first one closed") {
  constexpr int kN = 32;
  const std::vector<Vec3> cloud = sphere_points(40000, 1);
  const FinishOptions options = options_for(kN, FinishMethod::fast);
  const FinishResult once = finish(torn_sphere(kN, 1), {cloud}, options);
  const FinishResult twice = finish(once.mesh, {cloud}, options);
  REQUIRE(twice.mesh == once.mesh);
}

TEST_CASE("the border of an open surface stays open") {
  constexpr int kN = 40;
  const double h = 2.0 / kN;
  TriangleMesh mesh = testing::sphere(kN);
  SECTION("a hemisphere") {
    testing::cut_where(mesh, [](const Vec3& p) { return p.z > 0.0; });
  }
  SECTION("the end of a tube") {
    for (Vec3& p : mesh.positions)
      p = Vec3(4.0 * h * p.x, 4.0 * h * p.y, p.z);
    testing::cut_where(mesh, [](const Vec3& p) { return p.z > 0.0; });
  }
  SECTION("a terrain") {
    testing::cut_where(mesh, [](const Vec3& p) { return p.z > -0.7; });
    for (Vec3& p : mesh.positions)
      p.z *= 0.3;
  }
  SECTION("a strip") {
    testing::cut_where(mesh, [](const Vec3& p) { return p.z > -0.8 || std::abs(p.y) > 0.1; });
  }
  const std::size_t faces = mesh.triangles.size();
  FinishOptions options = options_for(kN, FinishMethod::fast);
  options.min_component = 10;
  const FinishResult result = finish(mesh, {}, options);
  require_clean(result.mesh);
  REQUIRE(result.report.open_loops == 1);
  REQUIRE(result.mesh.triangles.size() >= faces - faces / 50);
}

TEST_CASE("the outline of a flat sheet is no hole, though the points of the sheet lie in it") {
  constexpr int kN = 40;
  TriangleMesh mesh = testing::cube(kN);
  testing::cut_where(mesh, [](const Vec3& p) { return p.z < 1.0; });
  std::mt19937_64 engine(1);
  std::vector<Vec3> cloud(static_cast<std::size_t>(9 * kN * kN));
  for (Vec3& p : cloud)
    p = {testing::uniform(engine, -1, 1), testing::uniform(engine, -1, 1), 1.0};
  const auto method = GENERATE(FinishMethod::fast, FinishMethod::full);
  const FinishResult result = finish(mesh, {cloud}, options_for(kN, method));
  require_clean(result.mesh);
  REQUIRE(result.report.open_loops == 1);
  double area = 0.0;
  for (const Triangle& t : result.mesh.triangles) {
    const auto& p = result.mesh.positions;
    area += 0.5 * glm::length(area_vector(p[t[0]], p[t[1]], p[t[2]]));
  }
  REQUIRE(area == Approx(4.0).epsilon(1e-6));
}

TEST_CASE("a crack that opens into a border is zipped, and the border stays") {
  constexpr int kN = 40;
  const double h = 2.0 / kN;
  TriangleMesh mesh = testing::sphere(kN);
  testing::cut_where(mesh, [](const Vec3& p) { return p.z > 0.0; });
  const double rim = report_mesh(mesh).longest_loop;
  testing::cut_where(mesh, [&](const Vec3& p) { return std::abs(p.y) < 0.3 * h && p.x > 0.2; });
  REQUIRE(report_mesh(mesh).longest_loop > rim + 2.0);  // up one side of the crack, down the other
  const FinishResult result = finish(mesh, {}, options_for(kN, FinishMethod::fast));
  require_clean(result.mesh);
  REQUIRE(result.report.open_loops == 1);
  REQUIRE(report_mesh(result.mesh).euler == 1);
  REQUIRE(report_mesh(result.mesh).longest_loop < rim + 6.0 * h);
}

TEST_CASE("a large hole is closed if the cloud has points in it, and stays otherwise") {
  constexpr int kN = 40;
  TriangleMesh mesh = testing::sphere(kN);
  testing::cut_where(mesh, [](const Vec3& p) { return p.z > 0.85; });  // about 66 h around
  const std::vector<Vec3> cloud = sphere_points(60000, 3);
  std::vector<Vec3> cloud_with_hole = cloud;
  std::erase_if(cloud_with_hole, [](const Vec3& p) { return p.z > 0.85; });
  const FinishOptions options = options_for(kN, FinishMethod::fast);
  REQUIRE(report_mesh(finish(mesh, {cloud}, options).mesh).euler == 2);
  REQUIRE(report_mesh(finish(mesh, {cloud_with_hole}, options).mesh).euler == 1);
}

TEST_CASE("a hole of a few pixels stays where the points around it leave it out, unless asked to") {
  constexpr int kN = 40;
  TriangleMesh mesh = testing::sphere(kN);
  const auto is_left_out = [](const Vec3& p) { return p.z > 0.985; };  // about seven pixels across
  testing::cut_where(mesh, is_left_out);
  std::vector<Vec3> cloud = sphere_points(60000, 4);
  std::erase_if(cloud, is_left_out);
  FinishOptions options = options_for(kN, FinishMethod::full);
  CHECK(report_mesh(finish(mesh, {cloud}, options).mesh).euler == 1);
  options.max_hole_perimeter = 30.0;
  CHECK(report_mesh(finish(mesh, {cloud}, options).mesh).euler == 2);
}

TEST_CASE("what no scan has reached is closed, but for a hole of the object in it") {
  constexpr int kN = 40;
  const double h = 2.0 / kN;
  const auto method = GENERATE(FinishMethod::fast, FinishMethod::full);
  TriangleMesh mesh = testing::sphere(kN);
  testing::cut_where(mesh, [](const Vec3& p) { return p.z > 0.85; });
  std::vector<Vec3> cloud = sphere_points(60000, 3);
  const Vec3 middle = glm::normalize(Vec3(0.25, 0.0, 0.95));
  std::erase_if(cloud, [&](const Vec3& p) { return glm::length(p - middle) < 4.0 * h; });
  const MeshReport report = report_mesh(finish(mesh, {cloud}, options_for(kN, method)).mesh);
  CHECK(report.euler == 1);
  CHECK(report.boundary_loops == 1);
  CHECK(report.longest_loop > 20.0 * h);  // around what was left out: 8 pi h
  CHECK(report.longest_loop < 33.0 * h);
}

/// Evenly spread over a square of this side, in the plane of two axes.
void add_square(std::vector<Vec3>& points, const Vec3& along, const Vec3& across, double side) {
  constexpr double kSpacing = 0.4;
  for (double s = -0.5 * side; s <= 0.5 * side; s += kSpacing) {
    for (double t = -0.5 * side; t <= 0.5 * side; t += kSpacing)
      points.push_back(s * along + t * across);
  }
}

TEST_CASE("where a wall goes through another, the surface around stays") {
  constexpr std::uint32_t kSide = 40, kWall = 16;
  TriangleMesh mesh = shapes::square_sheet(kSide);
  testing::cut_where(mesh,
                     [](const Vec3& p) { return std::abs(p.x) < 0.5 && std::abs(p.y) < 9.5; });
  TriangleMesh wall = shapes::square_sheet(kWall);
  for (Vec3& p : wall.positions)
    p = {0.0, p.x, p.y};
  testing::append(mesh, wall);
  std::vector<Vec3> cloud;
  add_square(cloud, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, kSide);
  const auto beside = [](const Vec3& p) { return std::abs(p.x) > 2.0; };
  const std::vector<Vec3> floor = cloud;
  add_square(cloud, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}, kWall);
  const FinishOptions options{.method = FinishMethod::fast, .pixel_size = 1.0, .regrow = true};
  const FinishResult result = finish(mesh, {cloud}, options);
  require_clean(result.mesh);
  const std::vector<std::uint8_t> is_covered = covered_points(floor, result.mesh, 0.5);
  std::size_t lost = 0;
  for (std::size_t i = 0; i < floor.size(); ++i)
    lost += is_covered[i] == 0 && beside(floor[i]) ? 1 : 0;
  CAPTURE(lost, floor.size());
  CHECK(lost == 0);
}

/// The same mesh with its vertices and faces in another order.
TriangleMesh shuffled(const TriangleMesh& mesh, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::vector<std::uint32_t> place(mesh.positions.size());
  std::iota(place.begin(), place.end(), 0U);
  std::shuffle(place.begin(), place.end(), engine);
  TriangleMesh result;
  result.positions.resize(mesh.positions.size());
  for (std::size_t v = 0; v < place.size(); ++v)
    result.positions[place[v]] = mesh.positions[v];
  for (const auto& [a, b, c] : mesh.triangles)
    result.triangles.push_back({place[a], place[b], place[c]});
  std::shuffle(result.triangles.begin(), result.triangles.end(), engine);
  return result;
}

TEST_CASE("which holes stay does not depend on the order of vertices and faces") {
  constexpr int kN = 48;
  const double h = 2.0 / kN;
  TriangleMesh mesh = testing::sphere(kN);
  std::vector<Vec3> cloud = sphere_points(90000, 6);
  std::mt19937_64 engine(7);
  std::size_t holes = 0;
  for (int i = 0; i < 8; ++i) {
    const Vec3 middle = testing::direction(engine);
    const auto is_left_out = [&](const Vec3& p) { return glm::length(p - middle) < 5.0 * h; };
    testing::cut_where(mesh, is_left_out);
    std::erase_if(cloud, is_left_out);
  }
  const FinishOptions options = options_for(kN, FinishMethod::full);
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    CAPTURE(seed);
    const FinishResult result = finish(shuffled(mesh, seed), {cloud}, options);
    require_clean(result.mesh);
    if (holes == 0) holes = result.report.open_loops;
    CHECK(holes > 3);
    CHECK(result.report.open_loops == holes);
  }
}

TEST_CASE("points so sparse that discs of two pixels hold none show no hole") {
  constexpr int kN = 40;
  TriangleMesh mesh = testing::sphere(kN);
  const auto is_cut = [](const Vec3& p) { return p.z > 0.985; };
  testing::cut_where(mesh, is_cut);
  std::vector<Vec3> cloud = sphere_points(900, 5);  // three pixels apart
  std::erase_if(cloud, is_cut);
  const FinishOptions options = options_for(kN, FinishMethod::fast);
  CHECK(report_mesh(finish(mesh, {cloud}, options).mesh).euler == 2);
}

TEST_CASE("a crack between two pieces is bridged and closed") {
  constexpr int kN = 32;
  TriangleMesh mesh = testing::sphere(kN);
  testing::cut_where(mesh, [](const Vec3& p) { return std::abs(p.z) < 0.01; });
  REQUIRE(report_mesh(mesh).components == 2);
  const FinishResult result = finish(mesh, {}, options_for(kN, FinishMethod::fast));
  require_clean(result.mesh);
  REQUIRE(result.report.bridged_loops == 1);
  REQUIRE(report_mesh(result.mesh).components == 1);
  REQUIRE(report_mesh(result.mesh).euler == 2);
}

TEST_CASE("loops of one component are never joined to a handle") {
  // A thin slab with a hole in each face, opposite to each other and one pixel apart.
  constexpr int kN = 32;
  TriangleMesh mesh = testing::cube(kN);
  for (Vec3& p : mesh.positions)
    p.z *= 0.03;
  testing::cut_where(mesh, [](const Vec3& p) { return std::hypot(p.x, p.y) < 0.3; });
  REQUIRE(bridge_loops(mesh, pieces_of(mesh), PointGrid({}, Box{}, 1.0), 2.0 / kN) == 0);
  const FinishResult result = finish(mesh, {}, options_for(kN, FinishMethod::fast));
  REQUIRE(report_mesh(result.mesh).euler == 2);
}

TEST_CASE("a piece that faces the wrong way is turned, and becomes a part of the whole") {
  constexpr int kN = 32;
  TriangleMesh mesh = testing::sphere(kN);
  testing::cut_where(mesh, [](const Vec3& p) { return std::abs(p.z - 0.5) < 0.01; });
  for (Triangle& t : mesh.triangles) {
    if (mesh.positions[t[0]].z > 0.5) std::swap(t[1], t[2]);
  }
  const FinishResult result =
      finish(mesh, {sphere_points(40000, 1)}, options_for(kN, FinishMethod::fast));
  require_clean(result.mesh);
  CHECK(result.report.turned_pieces == 1);
  CHECK(report_mesh(result.mesh).components == 1);
  CHECK(report_mesh(result.mesh).euler == 2);
  CHECK(testing::volume_of(result.mesh) > 0.9 * 4.18879);
}

TEST_CASE("small pieces are dropped and counted") {
  TriangleMesh mesh = testing::sphere(16);
  const TriangleMesh crumb = testing::cube(2);
  const auto shift = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vec3& p : crumb.positions)
    mesh.positions.push_back(0.1 * p + Vec3(1.3, 0, 0));
  for (const Triangle& t : crumb.triangles) {
    mesh.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  }
  const FinishResult result = finish(mesh, {}, options_for(16, FinishMethod::fast));
  REQUIRE(result.mesh == testing::sphere(16));
  REQUIRE(result.report.dropped_components == 1);
  REQUIRE(result.report.dropped_faces == crumb.triangles.size());
}

TEST_CASE("even random crumpling ends without self-intersections") {
  const std::uint64_t seed = GENERATE(1U, 2U, 3U);
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  TriangleMesh mesh = testing::sphere(24);
  for (Vec3& p : mesh.positions) {
    p += 0.1 * Vec3{uniform(engine, -1, 1), uniform(engine, -1, 1), uniform(engine, -1, 1)};
  }
  FinishOptions options = options_for(24, FinishMethod::fast);
  options.min_component = 4;
  const TriangleMesh finished = finish(mesh, {}, options).mesh;
  require_clean(finished);
  REQUIRE(8 * finished.triangles.size() > mesh.triangles.size());  // and much is still there
}

TEST_CASE("finish gives the same bits for any number of threads") {
  const TriangleMesh torn = torn_sphere(32, 7);
  const std::vector<Vec3> cloud = sphere_points(40000, 7);
  const auto method = GENERATE(FinishMethod::fast, FinishMethod::full);
  const FinishOptions options = options_for(32, method);
  TriangleMesh one, four;
  run_with_threads(1, [&] { one = finish(torn, {cloud}, options).mesh; });
  run_with_threads(4, [&] { four = finish(torn, {cloud}, options).mesh; });
  REQUIRE(one == four);
}

}  // namespace
}  // namespace rangezip
