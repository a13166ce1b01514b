#include "core/finish/unfold.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "core/mesh/mesh_report.h"
#include "core/mesh/self_intersection.h"

using namespace rangezip;

namespace {

constexpr double kH = 1.0;
constexpr int kSide = 12;

std::uint32_t at(int i, int k) {
  return static_cast<std::uint32_t>(k * kSide + i);
}

/// A flat sheet of kSide x kSide vertices, a pixel apart.
TriangleMesh sheet() {
  TriangleMesh mesh;
  for (int k = 0; k < kSide; ++k) {
    for (int i = 0; i < kSide; ++i)
      mesh.positions.emplace_back(i, k, 0.0);
  }
  for (int k = 0; k + 1 < kSide; ++k) {
    for (int i = 0; i + 1 < kSide; ++i) {
      mesh.triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
      mesh.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    }
  }
  return mesh;
}

/// With one vertex pulled up and over its neighbour: the faces between them hang over.
TriangleMesh folded_sheet(double height) {
  TriangleMesh mesh = sheet();
  mesh.positions[at(5, 5)] = Vec3(6.6, 5.2, height);
  return mesh;
}

std::vector<Vec3> points_on_sheet() {
  std::vector<Vec3> points;
  for (double y = 0.0; y < kSide - 1; y += 0.4) {
    for (double x = 0.0; x < kSide - 1; x += 0.4)
      points.emplace_back(x, y, 0.0);
  }
  return points;
}

PointGrid grid_of(const std::vector<Vec3>& points) {
  Box region;
  for (const Vec3& p : points)
    region.add(p);
  return {points, region, 0.5 * kH};
}

/// Least cosine between a face and the z axis.
double least_upright(const TriangleMesh& mesh) {
  double least = 1.0;
  for (const Triangle& t : mesh.triangles)
    least = std::min(least, unit_normal(mesh.positions, t).z);
  return least;
}

double highest(const TriangleMesh& mesh) {
  double height = 0.0;
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t)
      height = std::max(height, mesh.positions[v].z);
  }
  return height;
}

}  // namespace

TEST_CASE("a fold in a sheet whose points are flat becomes flat", "[finish]") {
  TriangleMesh mesh = folded_sheet(0.5 * kH);
  REQUIRE(least_upright(mesh) < -0.5);
  REQUIRE(self_intersections(mesh).empty());
  const std::vector<Vec3> points = points_on_sheet();
  CHECK(unfold(mesh, grid_of(points), {.pixel_size = kH}) == 1);
  CHECK(least_upright(mesh) > 0.99);
  CHECK(highest(mesh) < 1e-9);
  remove_unused_vertices(mesh);
  const MeshReport report = report_mesh(mesh);
  CHECK(report.components == 1);
  CHECK(report.euler == 1);
  CHECK(report.nonmanifold_edges == 0);
  CHECK(self_intersections(mesh).empty());
}

TEST_CASE("a fold that points lie on, far from the sheet, stays", "[finish]") {
  TriangleMesh mesh = folded_sheet(1.5 * kH);
  std::vector<Vec3> points;  // all over the folded surface
  for (const Triangle& t : mesh.triangles) {
    const Vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
    for (int i = 0; i <= 6; ++i) {
      for (int k = 0; i + k <= 6; ++k)
        points.push_back(a + (i / 6.0) * (b - a) + (k / 6.0) * (c - a));
    }
  }
  const TriangleMesh before = mesh;
  CHECK(unfold(mesh, grid_of(points), {.pixel_size = kH}) == 0);
  CHECK(mesh == before);
}

TEST_CASE("a long edge as sharp as a knife, and the end of a sheet, are no folds", "[finish]") {
  TriangleMesh blade = sheet();  // folded along x = 5, its halves 20 degrees apart
  for (Vec3& p : blade.positions) {
    if (p.x > 5.0) p = Vec3(5.0 - (p.x - 5.0) * std::cos(0.35), p.y, (p.x - 5.0) * std::sin(0.35));
  }
  TriangleMesh at_end = sheet();  // folded over its corner
  at_end.positions[at(1, 1)] = Vec3(-0.6, 0.2, 0.5);
  const std::vector<Vec3> none;
  const PointGrid cloud(none, Box{}, kH);
  for (const TriangleMesh& before : {blade, at_end}) {
    TriangleMesh mesh = before;
    CHECK(unfold(mesh, cloud, {.pixel_size = kH}) == 0);
    CHECK(mesh == before);
  }
}
