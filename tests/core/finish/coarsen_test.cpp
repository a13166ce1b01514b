#include "core/finish/coarsen.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/mesh/mesh_report.h"
#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

constexpr double kDegree = 0.017453292519943295;

/// The sheet [-1, 1]^2 of n x n x 2 triangles, lifted to the given heights.
template <class Height>
TriangleMesh sheet(int n, Height height) {
  TriangleMesh mesh = testing::cube(n);
  testing::cut_where(mesh, [](const Vec3& p) { return p.z < 1.0; });
  for (Vec3& p : mesh.positions)
    p.z = height(p.x, p.y);
  return mesh;
}

MeshReport coarsened(TriangleMesh& mesh, const CoarsenOptions& options) {
  coarsen(mesh, options);
  remove_unused_vertices(mesh);
  const MeshReport report = report_mesh(mesh);
  REQUIRE(report.is_manifold());
  return report;
}

double squared_distance(const TriangleMesh& mesh, const Vec3& p) {
  double least = 4.0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 off = closest_point_on_triangle(p, mesh.positions[t[0]], mesh.positions[t[1]],
                                               mesh.positions[t[2]]) -
                     p;
    least = std::min(least, glm::dot(off, off));
  }
  return least;
}

TEST_CASE("a cube of few triangles is still the cube, and they are well shaped") {
  TriangleMesh mesh = testing::cube(16);
  const MeshReport report = coarsened(mesh, {.triangles = 100});
  REQUIRE(report.faces == 100);
  REQUIRE(report.euler == 2);
  REQUIRE(testing::volume_of(mesh) == Approx(8.0).epsilon(1e-4));
  for (const Vec3& p : mesh.positions)
    REQUIRE(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) == Approx(1.0).epsilon(1e-4));
  REQUIRE(testing::smallest_angle(mesh) > 14.9 * kDegree);
}

TEST_CASE("triangles are long where the surface bends one way only") {
  TriangleMesh mesh = sheet(40, [](double x, double) { return x * x; });
  const MeshReport report = coarsened(mesh, {.triangles = 400});
  REQUIRE(report.faces <= 400);
  REQUIRE(report.euler == 1);
  double across = 0.0, along = 0.0;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 edge = mesh.positions[t[(i + 1) % 3]] - mesh.positions[t[i]];
      across += std::abs(edge.x);
      along += std::abs(edge.y);
    }
  }
  REQUIRE(along > 1.4 * across);
}

TEST_CASE("the boundary has fewer edges as well, and stays where it was") {
  TriangleMesh mesh = sheet(40, [](double x, double y) { return 0.2 * x * y; });
  const MeshReport report = coarsened(mesh, {.triangles = 60});
  REQUIRE(report.faces <= 60);
  REQUIRE(report.euler == 1);
  REQUIRE(report.boundary_edges < 40);
  double area = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
    area += 0.5 * std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
  }
  REQUIRE(area == Approx(4.0).epsilon(0.005));
}

TEST_CASE("with a tolerance the faces stay as near as it says, and there are fewer if it is more") {
  const TriangleMesh fine = testing::sphere(40);
  const double tolerance = GENERATE(5e-4, 2e-3);
  TriangleMesh mesh = fine, loose = fine;
  const MeshReport report = coarsened(mesh, {.tolerance = tolerance});
  REQUIRE(report.euler == 2);
  REQUIRE(report.faces < fine.triangles.size() / 2);
  REQUIRE(coarsened(loose, {.tolerance = 3.0 * tolerance}).faces < report.faces / 2);
  double sum = 0.0;
  for (const Vec3& p : fine.positions)
    sum += squared_distance(mesh, p);
  REQUIRE(std::sqrt(sum / static_cast<double>(fine.positions.size())) < tolerance);
  REQUIRE(testing::smallest_angle(mesh) > 14.9 * kDegree);
}

TEST_CASE("vertices that are to be kept stay, and the faces between them") {
  TriangleMesh mesh = testing::sphere(16);
  const TriangleMesh fine = mesh;
  const auto is_kept = [](const Vec3& p) { return p.z > 0.5; };
  CoarsenOptions options{.triangles = 100};
  for (const Vec3& p : mesh.positions)
    options.is_kept.push_back(is_kept(p) ? 1 : 0);
  coarsen(mesh, options);
  const auto between_kept = [&](const TriangleMesh& of) {
    return std::count_if(of.triangles.begin(), of.triangles.end(), [&](const Triangle& t) {
      return std::all_of(t.begin(), t.end(), [&](auto v) { return options.is_kept[v] != 0; });
    });
  };
  CHECK(between_kept(mesh) == between_kept(fine));
  for (std::size_t v = 0; v < fine.positions.size(); ++v) {
    if (options.is_kept[v] != 0) CHECK(mesh.positions[v] == fine.positions[v]);
  }
  CHECK(mesh.triangles.size() < fine.triangles.size() / 2);
}

TEST_CASE("coarsening ends where no edge is left that may go") {
  TriangleMesh mesh = testing::cube(4);
  const MeshReport report = coarsened(mesh, {.triangles = 1});
  REQUIRE(report.euler == 2);
  REQUIRE(report.faces >= 4);
}

}  // namespace
}  // namespace rangezip
