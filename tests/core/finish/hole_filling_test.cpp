#include "core/finish/hole_filling.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/error.h"
#include "core/finish/verified_fills.h"
#include "core/mesh/mesh_report.h"
#include "core/mesh/self_intersection.h"
#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kUnlimited = 1e9;

TriangleMesh sphere_with_hole(int n, double below) {
  TriangleMesh mesh = testing::sphere(n);
  testing::cut_where(mesh, [&](const Vec3& p) { return p.z > below; });
  return mesh;
}

TEST_CASE("a sphere with a hole becomes a closed sphere again") {
  const double height = GENERATE(0.95, 0.8, 0.6);
  CAPTURE(height);
  const TriangleMesh whole = testing::sphere(24);
  const FilledMesh filled = fill_mesh_holes(sphere_with_hole(24, height), 0.0, kUnlimited);
  REQUIRE(filled.filled_holes == 1);
  const MeshReport report = report_mesh(filled.mesh);
  REQUIRE(report.is_manifold());
  REQUIRE(report.boundary_edges == 0);
  REQUIRE(report.euler == 2);
  REQUIRE(self_intersections(filled.mesh).empty());
  // More than the sphere with the cap cut off flat, and less than with the cone that is tangent to
  // it at the rim; the rim itself runs up to one edge (2 pi / 96) below the cut.
  const double rim = height - 2.0 * kPi / 96.0;
  const double radius2 = 1.0 - rim * rim;
  const double cap = kPi * (2.0 / 3.0 - rim + rim * rim * rim / 3.0);
  const double cone = kPi / 3.0 * radius2 * (radius2 / rim);
  const double sphere = testing::volume_of(whole);
  REQUIRE(testing::volume_of(filled.mesh) > sphere - cap);
  REQUIRE(testing::volume_of(filled.mesh) < sphere - cap + cone);
}

TEST_CASE("a fill that was made before is as good as one made for the request") {
  const TriangleMesh open = sphere_with_hole(24, 0.8);
  const CornerTable table(open.triangles, open.positions.size());
  const std::vector<BoundaryLoop> loops = boundary_loops(table);
  REQUIRE(loops.size() == 1);
  constexpr double kEdge = 0.06;
  const VerifiedFillOptions options{.edge_length = kEdge, .zip_width = 3.0 * kEdge};
  TriangleMesh fresh = open, kept = open;
  REQUIRE(fill_verified(fresh, table, {{.loop = loops[0]}}, options).filled_holes == 1);
  const HoleFill fill = fill_loop(open.positions, table, loops[0], FillShape::smooth, kEdge);
  REQUIRE(fill_verified(kept, table, {{.loop = loops[0], .fill = fill}}, options).filled_holes ==
          1);
  REQUIRE(kept == fresh);
}

TEST_CASE("edges that are to be all but nothing are a thousandth of the loop") {
  const FilledMesh filled = fill_mesh_holes(sphere_with_hole(24, 0.8), 1e-12, kUnlimited);
  // A triangle of such edges has an area of half their square; the cap that is missing about
  // 2 pi 0.2 and a perimeter of 2 pi 0.6.
  const double edge = 0.001 * 2.0 * kPi * 0.6;
  REQUIRE(static_cast<double>(filled.filled_faces) * 0.5 * edge * edge < 3.0 * 2.0 * kPi * 0.2);
  REQUIRE(filled.filled_holes == 1);
}

TEST_CASE("a smooth fill of a sphere stays near the sphere") {
  const FilledMesh filled = fill_mesh_holes(sphere_with_hole(24, 0.9), 0.0, kUnlimited);
  // A flat fill of a cap this wide lies up to 1 - 0.9 + one edge below the sphere; the smooth one
  // keeps its curvature, and half of that is a loose bound for it.
  const double sag = 1.0 - 0.9 + 2.0 * kPi / 96.0;
  for (const Vec3& p : filled.mesh.positions) {
    REQUIRE(std::abs(glm::length(p) - 1.0) < 0.5 * sag);
  }
}

TEST_CASE("a hole in a plane is filled in the plane with triangles as large as around it") {
  TriangleMesh mesh;
  constexpr int kSize = 20;
  const auto at = [](int x, int y) { return static_cast<std::uint32_t>(y * (kSize + 1) + x); };
  for (int y = 0; y <= kSize; ++y) {
    for (int x = 0; x <= kSize; ++x)
      mesh.positions.emplace_back(x, y, 0.0);
  }
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      mesh.triangles.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
      mesh.triangles.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  }
  testing::cut_where(
      mesh, [](const Vec3& p) { return p.x > 5.5 && p.x < 14.5 && p.y > 5.5 && p.y < 14.5; });
  const double outline = 4.0 * kSize;
  const FilledMesh filled = fill_mesh_holes(mesh, 0.0, outline - 1.0);
  REQUIRE(filled.filled_holes == 1);
  REQUIRE(report_mesh(filled.mesh).boundary_loops == 1);
  double area = 0.0;
  for (const Triangle& t : filled.mesh.triangles) {
    const Vec3 a = area_vector(filled.mesh.positions[t[0]], filled.mesh.positions[t[1]],
                               filled.mesh.positions[t[2]]);
    REQUIRE(a.z > 0.0);  // nothing folds over
    area += 0.5 * a.z;
    REQUIRE(longest_side(filled.mesh, t) < 3.0);
  }
  REQUIRE(area == Approx(kSize * kSize).epsilon(1e-9));
  for (const Vec3& p : filled.mesh.positions)
    REQUIRE(std::abs(p.z) < 1e-9);
}

TEST_CASE("loops beyond the perimeter stay open") {
  const TriangleMesh open = sphere_with_hole(16, 0.8);
  const FilledMesh filled = fill_mesh_holes(open, 0.0, 2.0);  // the rim measures about 2 pi 0.6
  REQUIRE(filled.filled_holes == 0);
  REQUIRE(filled.mesh == open);
}

TEST_CASE("long cracks are filled") {
  TriangleMesh mesh = testing::sphere(64);
  testing::cut_where(mesh, [](const Vec3& p) { return std::abs(p.z) < 0.02 && p.x > -0.9; });
  REQUIRE(report_mesh(mesh).boundary_edges > 300);
  const FilledMesh filled = fill_mesh_holes(mesh, 0.0, kUnlimited);
  REQUIRE(filled.filled_holes == 1);
  REQUIRE(report_mesh(filled.mesh).euler == 2);
  REQUIRE(self_intersections(filled.mesh).empty());
  REQUIRE(testing::volume_of(filled.mesh) == Approx(4.0 / 3.0 * kPi).epsilon(0.01));
}

TEST_CASE("a lone triangle cannot be closed without folding") {
  const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {}};
  REQUIRE(fill_mesh_holes(mesh, 0.0, kUnlimited).mesh == mesh);
}

TEST_CASE("vertices keep their source and new ones have none") {
  TriangleMesh mesh = sphere_with_hole(16, 0.7);
  for (std::uint32_t i = 0; i < mesh.positions.size(); ++i)
    mesh.sources.push_back({i, 7});
  const FilledMesh filled = fill_mesh_holes(mesh, 0.0, kUnlimited);
  REQUIRE(filled.mesh.sources.size() == filled.mesh.positions.size());
  REQUIRE(filled.mesh.positions.size() > mesh.positions.size());
  for (std::size_t i = 0; i < filled.mesh.positions.size(); ++i) {
    if (i < mesh.positions.size()) {
      REQUIRE(filled.mesh.sources[i] == mesh.sources[i]);
    } else {
      REQUIRE(filled.mesh.sources[i] == VertexSource{});
    }
  }
}

TEST_CASE("fill_mesh_holes refuses lengths that are negative or not finite") {
  const double bad = GENERATE(-1.0, std::numeric_limits<double>::quiet_NaN(),
                              std::numeric_limits<double>::infinity());
  REQUIRE_THROWS_AS(fill_mesh_holes({}, bad, 1.0), InvalidArgument);
  REQUIRE_THROWS_AS(fill_mesh_holes({}, 1.0, bad), InvalidArgument);
}

}  // namespace
}  // namespace rangezip
