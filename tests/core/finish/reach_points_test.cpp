#include "core/finish/reach_points.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "core/finish/angle_defect.h"
#include "core/finish/corner_table.h"
#include "core/mesh/coverage.h"
#include "core/mesh/mesh_report.h"
#include "core/mesh/self_intersection.h"
#include "tests/core/finish/shapes.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

constexpr double kH = 1.0;
constexpr double kRadius = 20.0;
constexpr double kSlope = 0.2217;  // a rim of 25 degrees
constexpr double kCutOff = 2.0;
constexpr int kSegments = 110;
constexpr ReachPointsOptions kOptions{.pixel_size = kH, .edge = 1.1 * kH, .noise = 0.0};

TriangleSoup double_cone(double cut_off) {
  return shapes::double_cone(kRadius, kSlope, cut_off, kSegments);
}

TriangleMesh cut_off_cone() {
  return shapes::to_mesh(double_cone(kCutOff));
}

/// About five points a pixel.
std::vector<Vec3> points_of(const TriangleSoup& soup, std::uint64_t seed) {
  const auto count = static_cast<std::size_t>(5.0 * shapes::area_of(soup));
  return shapes::to_points(shapes::sampled(soup, count, seed));
}

PointGrid grid_of(const std::vector<Vec3>& points) {
  return {points, Box{Vec3(-2.0 * kRadius), Vec3(2.0 * kRadius)}, 0.7 * kH};
}

double farthest_from_axis(const TriangleMesh& mesh) {
  double farthest = 0.0;
  for (const Vec3& p : mesh.positions)
    farthest = std::max(farthest, std::hypot(p.x, p.y));
  return farthest;
}

TEST_CASE("a sharp rim that was cut off comes out to the points, and nowhere beyond") {
  const std::uint64_t seed = GENERATE(1U, 2U, 3U);
  CAPTURE(seed);
  const std::vector<Vec3> points = points_of(double_cone(0.0), seed);
  TriangleMesh mesh = cut_off_cone();
  const std::size_t before = points_off(points, mesh, 0.25 * kH).size();
  REQUIRE(before > 1000);
  REQUIRE(reach_points(mesh, grid_of(points), kOptions) > kSegments);
  CHECK(points_off(points, mesh, 0.25 * kH).size() < before / 10);
  CHECK(farthest_from_axis(mesh) > kRadius - 0.2 * kH);
  CHECK(farthest_from_axis(mesh) <= kRadius);
  const MeshReport report = report_mesh(mesh);
  CHECK(report.is_manifold());
  CHECK(report.euler == 2);
  CHECK(report.boundary_loops == 0);
  CHECK(self_intersections(mesh).empty());
}

TEST_CASE("what is nowhere short of the points stays as it is") {
  const TriangleSoup whole = double_cone(0.0);
  TriangleMesh mesh = shapes::to_mesh(whole);
  const TriangleMesh before = mesh;
  CHECK(reach_points(mesh, grid_of(points_of(whole, 4)), kOptions) == 0);
  CHECK(mesh.positions == before.positions);
  CHECK(mesh.triangles == before.triangles);
}

TEST_CASE("no rim follows a point all alone into the air") {
  const TriangleSoup whole = double_cone(0.0);
  std::vector<Vec3> points = points_of(whole, 5);
  points.emplace_back(kRadius + 1.5 * kH, 0.0, 0.0);
  TriangleMesh mesh = shapes::to_mesh(whole);
  CHECK(reach_points(mesh, grid_of(points), kOptions) == 0);
}

TEST_CASE("where nothing is sharp points off the mesh are none of a rim") {
  TriangleMesh mesh = testing::sphere(20);
  for (Vec3& p : mesh.positions)
    p *= 10.0;
  std::vector<Vec3> points = points_of(shapes::sphere(10.5), 6);
  CHECK(reach_points(mesh, grid_of(points), kOptions) == 0);
}

TEST_CASE("of a noisy cloud no point is reached for") {
  TriangleMesh mesh = cut_off_cone();
  ReachPointsOptions noisy = kOptions;
  noisy.noise = 0.2 * kH;
  CHECK(reach_points(mesh, grid_of(points_of(double_cone(0.0), 7)), noisy) == 0);
}

TEST_CASE("where a few points of a rim lie farther out no vertex sticks out alone") {
  const std::uint64_t seed = GENERATE(1U, 2U, 3U);
  CAPTURE(seed);
  const TriangleSoup whole = double_cone(0.0);
  std::vector<Vec3> points = points_of(whole, seed);
  shapes::Random random(seed + 100);  // not the sequence that sampled
  for (Vec3& p : points)
    p += 0.2 * kH * Vec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
  constexpr int kPlaces = 12;
  for (int i = 0; i < 2 * kPlaces; ++i) {
    const double turn = 2.0 * std::numbers::pi / kPlaces * (i % kPlaces) + random.between(0, 0.01);
    const double radius = kRadius + random.between(0.26, 0.32) * kH;
    points.emplace_back(radius * std::cos(turn), radius * std::sin(turn), 0.0);
  }
  TriangleMesh mesh = shapes::to_mesh(whole);
  const auto roughest = [&] {
    const CornerTable table(mesh.triangles, mesh.positions.size());
    double most = 0.0;
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v)
      most = std::max(most, roughness_around(table, mesh.positions, v));
    return most;
  };
  REQUIRE(roughest() < 0.1);
  REQUIRE(reach_points(mesh, grid_of(points), kOptions) >= kPlaces);
  CHECK(roughest() < 1.0);
  CHECK(self_intersections(mesh).empty());
}

TEST_CASE("a boundary stays where a rim that runs into it is brought out") {
  TriangleMesh mesh = cut_off_cone();
  testing::cut_where(mesh, [](const Vec3& p) { return p.y < 0.0; });
  const auto border = [](const TriangleMesh& of) {
    const CornerTable table(of.triangles, of.positions.size());
    std::vector<Vec3> places;
    for (std::uint32_t v = 0; v < of.positions.size(); ++v) {
      if (table.corner_of(v) != CornerTable::kNone && table.is_boundary(v))
        places.push_back(of.positions[v]);
    }
    return places;
  };
  const std::vector<Vec3> before = border(mesh);
  REQUIRE(reach_points(mesh, grid_of(points_of(double_cone(0.0), 8)), kOptions) > 0);
  CHECK(border(mesh) == before);
  CHECK(report_mesh(mesh).is_manifold());
}

}  // namespace
}  // namespace rangezip
