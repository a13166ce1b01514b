#include "core/finish/verified_fills.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

#include "core/mesh/mesh_report.h"
#include "core/mesh/self_intersection.h"
#include "tests/core/finish/shapes.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

constexpr int kSide = 20;

/// A square sheet of faces of side 1 in z = 0 around the middle, with a round hole.
TriangleMesh sheet_with_hole(double radius) {
  TriangleMesh mesh = shapes::square_sheet(kSide);
  testing::cut_where(mesh, [&](const Vec3& p) { return glm::length(p) < radius; });
  return mesh;
}

/// Adds a triangle that stands across the plane z = 0 at x, as wide as 2 half_width.
void add_blade(TriangleMesh& mesh, double x, double half_width) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(),
                        {{x, -2.0 * half_width, -1.0}, {x, 2.0 * half_width, -1.0}, {x, 0.0, 1.0}});
  mesh.triangles.push_back({first, first + 1, first + 2});
}

struct Filled {
  TriangleMesh mesh;
  VerifiedFills fills;
};

/// Fills the hole, which is the shorter loop of the sheet; the blade comes last.
Filled fill_hole(TriangleMesh mesh, bool partly) {
  const CornerTable table(mesh.triangles, mesh.positions.size());
  std::vector<BoundaryLoop> loops = boundary_loops(table);
  std::erase_if(loops, [&](const BoundaryLoop& loop) {
    return loop.corners.size() >= 4 * kSide || loop.corners[0] / 3 + 1 == mesh.triangles.size();
  });
  REQUIRE(loops.size() == 1);
  Filled filled{mesh, {}};
  filled.fills = fill_verified(filled.mesh, table, {{loops[0], FillShape::smooth}},
                               {.edge_length = 1.0, .partly = partly});
  return filled;
}

TEST_CASE("a fill that would cross something is not made", "[finish]") {
  TriangleMesh mesh = sheet_with_hole(4.5);
  add_blade(mesh, 1.0, 0.5);
  const Filled filled = fill_hole(mesh, false);
  CHECK(filled.mesh.triangles == mesh.triangles);
  CHECK(filled.fills.rejected == std::vector<std::size_t>{0});
}

TEST_CASE("of a fill that would cross something the rest is made, and the mesh stays manifold",
          "[finish]") {
  TriangleMesh mesh = sheet_with_hole(4.5);
  add_blade(mesh, 1.0, 0.5);
  const Filled filled = fill_hole(mesh, true);
  CHECK(filled.fills.pieces > 0);
  CHECK(filled.fills.rejected.empty());
  CHECK(filled.fills.obstacles.empty());
  CHECK(filled.mesh.triangles.size() == mesh.triangles.size() + filled.fills.filled_faces);
  CHECK(report_mesh(filled.mesh).is_manifold());
  CHECK(self_intersections(filled.mesh).empty());
}

TEST_CASE("where a fill is hindered all over, the faces in the way are named", "[finish]") {
  TriangleMesh mesh = shapes::square_sheet(kSide);
  const Triangle hole = mesh.triangles[kSide * kSide + kSide];
  std::erase(mesh.triangles, hole);
  const Vec3 middle =
      (mesh.positions[hole[0]] + mesh.positions[hole[1]] + mesh.positions[hole[2]]) / 3.0;
  add_blade(mesh, middle.x, 20.0);
  const Filled filled = fill_hole(mesh, true);
  CHECK(filled.mesh.triangles == mesh.triangles);
  CHECK(filled.fills.rejected.empty());
  const auto blade = static_cast<std::uint32_t>(mesh.triangles.size() - 1);
  CHECK(filled.fills.obstacles == std::vector<std::uint32_t>{blade});
}

}  // namespace
}  // namespace rangezip
