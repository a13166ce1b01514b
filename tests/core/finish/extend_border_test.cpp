#include "core/finish/extend_border.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "core/finish/border_gaps.h"
#include "core/mesh/mesh_report.h"
#include "core/mesh/self_intersection.h"
#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

using testing::uniform;

constexpr int kN = 24;
constexpr double kH = 2.0 / kN;
const Box kRegion{Vec3(-2.5), Vec3(2.5)};

PointGrid grid_of(const std::vector<Vec3>& points) {
  return PointGrid(points, kRegion, 0.7 * kH);
}

/// The square [-half, half]^2 at z = 0, facing up.
TriangleMesh sheet(double half) {
  TriangleMesh mesh = testing::cube(kN);
  testing::cut_where(mesh, [](const Vec3& p) { return p.z < 1.0; });
  for (Vec3& p : mesh.positions)
    p = Vec3(half * p.x, half * p.y, 0.0);
  return mesh;
}

/// About nine a pixel in [-1, 1]^2 at z = 0.
std::vector<Vec3> square_points(std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::vector<Vec3> points(static_cast<std::size_t>(9 * kN * kN));
  for (Vec3& p : points)
    p = {uniform(engine, -1, 1), uniform(engine, -1, 1), 0.0};
  return points;
}

/// How far a point of the plane z = 0 is from the mesh in that plane.
double distance_from(const TriangleMesh& mesh, const Vec3& p) {
  double nearest = 1e9;
  for (const Triangle& t : mesh.triangles) {
    bool is_inside = true;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& a = mesh.positions[t[i]];
      const Vec3 edge = mesh.positions[t[(i + 1) % 3]] - a;
      if (glm::cross(edge, p - a).z >= 0.0) continue;
      is_inside = false;
      const double s = glm::clamp(glm::dot(p - a, edge) / glm::dot(edge, edge), 0.0, 1.0);
      nearest = std::min(nearest, glm::length(p - a - s * edge));
    }
    if (is_inside) return 0.0;
  }
  return nearest;
}

std::size_t count_beyond(const TriangleMesh& mesh, const std::vector<Vec3>& points, double least) {
  std::size_t count = 0;
  for (const Vec3& p : points)
    count += distance_from(mesh, p) > least ? 1 : 0;
  return count;
}

void require_clean(const TriangleMesh& mesh) {
  REQUIRE(report_mesh(mesh).is_manifold());
  REQUIRE(self_intersections(mesh).empty());
}

/// Of points of the cloud within h; what lies beyond by less than a thousandth does not matter.
void require_no_gaps(const TriangleMesh& mesh, const PointGrid& cloud) {
  const CornerTable table(mesh.triangles, mesh.positions.size());
  const FaceGrid faces(mesh, table, kH);
  REQUIRE(find_border_gaps(mesh, table, faces, cloud, {kH, 1.001e-3 * kH}).empty());
}

TEST_CASE("after extend_border no point within a pixel lies beyond the edge of a sheet") {
  const std::uint64_t seed = GENERATE(1U, 2U, 3U);
  CAPTURE(seed);
  const std::vector<Vec3> points = square_points(seed);
  const double margin = GENERATE(0.8, 2.5);  // pixels between the sheet's edge and the points'
  CAPTURE(margin);
  TriangleMesh mesh = sheet(1.0 - margin * kH);
  REQUIRE(count_beyond(mesh, points, 0.25 * kH) > 300);
  const ExtendBorderReport report = extend_border(mesh, grid_of(points), {kH});
  REQUIRE(report.steps >= 4 * kN / 2);
  REQUIRE(report.edges_left == 0);
  require_no_gaps(mesh, grid_of(points));
  REQUIRE(count_beyond(mesh, points, 0.01 * kH) == 0);
  require_clean(mesh);
  REQUIRE(report_mesh(mesh).boundary_loops == 1);
  // Vertices go to points, so none goes past them.
  for (const Vec3& p : mesh.positions) {
    REQUIRE(std::abs(p.x) <= 1.0 + 1e-6);
    REQUIRE(std::abs(p.y) <= 1.0 + 1e-6);
    REQUIRE(std::abs(p.z) < 1e-6 * kH);  // the points are stored as floats
  }
}

TEST_CASE("extend_border follows a curved surface") {
  std::mt19937_64 engine(5);
  std::vector<Vec3> points;
  while (points.size() < 20000) {
    const Vec3 p{uniform(engine, -1, 1), uniform(engine, -1, 1), uniform(engine, -1, 0.2)};
    const double length = glm::length(p);
    if (length > 0.1 && length < 1.0 && p.z < 0.2 * length) points.push_back(p / length);
  }
  TriangleMesh mesh = testing::sphere(kN);
  testing::cut_where(mesh, [](const Vec3& p) { return p.z > 0.2 - 0.3 * kH; });
  REQUIRE(extend_border(mesh, grid_of(points), {kH}).steps > 0);
  require_clean(mesh);
  require_no_gaps(mesh, grid_of(points));
  double highest = -1.0;
  for (const Vec3& p : mesh.positions) {
    highest = std::max(highest, p.z);
    // On a point, or part of the way from the border to it: a chord of at most 2 h is up to
    // h^2 / 2 below the sphere.
    REQUIRE(glm::length(p) < 1.0 + 1e-6);
    REQUIRE(glm::length(p) > 1.0 - 0.5 * kH * kH);
  }
  REQUIRE(highest > 0.2 - 0.1 * kH);
  REQUIRE(highest <= 0.2 + 1e-6);
}

TEST_CASE("a border where the points end already stays") {
  std::vector<Vec3> points = square_points(1);
  TriangleMesh mesh = sheet(1.0);
  SECTION("and no other points are there") {}
  SECTION("and single points lie farther than a pixel beyond it") {
    for (int i = -5; i <= 5; ++i)
      points.emplace_back(1.0 + 1.1 * kH, 4.0 * i * kH, 0.0);
  }
  const TriangleMesh before = mesh;
  REQUIRE(extend_border(mesh, grid_of(points), {kH}).steps == 0);
  REQUIRE(mesh == before);
}

TEST_CASE("points of the sheet on the other side of a crack do not count") {
  std::vector<Vec3> points;
  TriangleMesh mesh = sheet(1.0);
  const auto count = static_cast<std::uint32_t>(mesh.positions.size());
  const Vec3 across(2.0 + 0.6 * kH, 0.0, 0.0);
  for (const Vec3& p : square_points(3)) {
    points.push_back(p);
    points.push_back(p + across);
  }
  for (std::uint32_t v = 0; v < count; ++v)
    mesh.positions.push_back(mesh.positions[v] + across);
  const std::size_t faces = mesh.triangles.size();
  for (std::size_t f = 0; f < faces; ++f) {
    const Triangle t = mesh.triangles[f];
    mesh.triangles.push_back({t[0] + count, t[1] + count, t[2] + count});
  }
  const TriangleMesh before = mesh;
  const PointGrid cloud(points, {Vec3(-4), Vec3(4)}, 0.7 * kH);
  extend_border(mesh, cloud, {kH});
  REQUIRE(mesh == before);
}

TEST_CASE("extend_border takes steps back that let faces cross") {
  const double half = 1.0 - 0.8 * kH;
  TriangleMesh mesh = sheet(half);
  // Beside the way from each edge of one side to its point stands a needle, so far aside that the
  // edge is still what is nearest to the point, but in the way of a face up to it.
  const double edge = 2.0 * half / kN;
  std::vector<Vec3> points;
  for (int i = 0; i < kN; ++i) {
    const double middle = -half + (i + 0.5) * edge;
    points.emplace_back(half + 0.3 * edge, middle, 0.0);
    const Vec3 needle(half + 0.1 * edge, middle + 0.31 * edge, -0.4 * edge);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.push_back(needle);
    mesh.positions.push_back(needle + Vec3(0.001 * edge, 0.0, 0.0));
    mesh.positions.push_back(needle + Vec3(0.0, 0.0, 0.8 * edge));
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  REQUIRE(self_intersections(mesh).empty());
  const ExtendBorderReport report = extend_border(mesh, grid_of(points), {kH});
  REQUIRE(report.reverted_steps > 0);
  REQUIRE(report.steps > 0);
  require_clean(mesh);
}

TEST_CASE("extend_border leaves a closed mesh alone, and any mesh without a cloud") {
  TriangleMesh mesh = testing::cube(kN);
  const TriangleMesh before = mesh;
  REQUIRE(extend_border(mesh, grid_of(square_points(5)), {kH}).steps == 0);
  REQUIRE(mesh == before);
  TriangleMesh open = sheet(0.9);
  const TriangleMesh open_before = open;
  REQUIRE(extend_border(open, PointGrid({}, kRegion, kH), {kH}).steps == 0);
  REQUIRE(open == open_before);
}

}  // namespace
TEST_CASE("a border does not feather into a cloud that is no surface") {
  constexpr std::uint64_t kSeed = 5;
  INFO("seed " << kSeed);
  std::mt19937_64 engine(kSeed);
  std::vector<Vec3> points(40'000);
  for (Vec3& p : points)
    p = {uniform(engine, -2, 2), uniform(engine, -2, 2), uniform(engine, -0.5, 0.5)};
  TriangleMesh mesh = sheet(0.5);
  const std::size_t before = report_mesh(mesh).boundary_edges;
  extend_border(mesh, grid_of(points), {.pixel_size = kH});
  const MeshReport after = report_mesh(mesh);
  CHECK(after.boundary_edges > before);
  CHECK(after.boundary_edges < 5 * before);
  CHECK(after.nonmanifold_edges == 0);
  CHECK(self_intersections(mesh).empty());
}

TEST_CASE("no step makes an angle smaller than is asked for", "[finish]") {
  const std::vector<Vec3> points = square_points(3);
  const PointGrid cloud = grid_of(points);
  TriangleMesh mesh = sheet(1.0 - 0.8 * kH);  // with right triangles: of 45 degrees
  TriangleMesh without = mesh;
  extend_border(without, cloud, {.pixel_size = kH});
  REQUIRE(std::sin(testing::smallest_angle(without)) < 0.17);
  const ExtendBorderReport report =
      extend_border(mesh, cloud, {.pixel_size = kH, .smallest_angle = 0.17});
  CHECK(report.steps > 0);
  CHECK(std::sin(testing::smallest_angle(mesh)) >= 0.17 * (1.0 - 1e-12));
  require_clean(mesh);
}

}  // namespace rangezip
