#include "core/finish/verified_fills.h"

#include <catch2/catch.hpp>
#include <cstdint>
#include <vector>

#include "core/mesh/mesh_report.h"
#include "core/mesh/self_intersection.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

constexpr std::uint32_t kSide = 6;
constexpr double kRise = 0.8;

/// A sheet without the two faces of the cell around (0.5, 0.5), of which two opposite corners, and
/// what lies beyond them, rise by 0.8: a fill is either a ridge at z 0.8 or a valley at z 0.
TriangleMesh sheet_with_saddle_hole() {
  TriangleMesh mesh = shapes::square_sheet(kSide);
  const auto is_in_cell = [&](std::uint32_t v) {
    const Vec3& p = mesh.positions[v];
    return p.x > -0.5 && p.x < 1.5 && p.y > -0.5 && p.y < 1.5;
  };
  std::erase_if(mesh.triangles, [&](const Triangle& t) {
    return is_in_cell(t[0]) && is_in_cell(t[1]) && is_in_cell(t[2]);
  });
  for (Vec3& p : mesh.positions) {
    if ((p.x < 0.5 && p.y < 0.5) || (p.x > 0.5 && p.y > 0.5)) p.z = kRise;
  }
  return mesh;
}

/// Adds a small closed tetrahedron around a place.
void add_obstacle(TriangleMesh& mesh, const Vec3& middle, double size) {
  const auto base = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vec3& corner : {Vec3{1, 1, 1}, Vec3{-1, -1, 1}, Vec3{-1, 1, -1}, Vec3{1, -1, -1}})
    mesh.positions.push_back(middle + size * corner);
  for (const Triangle& t :
       {Triangle{0, 1, 3}, Triangle{0, 2, 1}, Triangle{0, 3, 2}, Triangle{1, 2, 3}})
    mesh.triangles.push_back({base + t[0], base + t[1], base + t[2]});
}

/// The loop with four edges, which is the hole.
VerifiedFills fill_the_hole(TriangleMesh& mesh) {
  const CornerTable table(mesh.triangles, mesh.positions.size());
  std::vector<FillRequest> requests;
  for (BoundaryLoop& loop : boundary_loops(table)) {
    if (loop.corners.size() == 4) requests.push_back({.loop = std::move(loop)});
  }
  REQUIRE(requests.size() == 1);
  return fill_verified(mesh, table, requests, {.edge_length = 1.0});
}

TEST_CASE("whichever of two fills something is in the way of, the other closes the hole") {
  const double height = GENERATE(0.0, kRise);
  CAPTURE(height);
  TriangleMesh mesh = sheet_with_saddle_hole();
  add_obstacle(mesh, {0.5, 0.5, height}, 0.1);
  REQUIRE(self_intersections(mesh).empty());
  const std::size_t open = report_mesh(mesh).boundary_edges;
  const VerifiedFills fills = fill_the_hole(mesh);
  REQUIRE(fills.filled_holes == 1);
  REQUIRE(fills.rejected.empty());
  REQUIRE(report_mesh(mesh).is_manifold());
  REQUIRE(report_mesh(mesh).boundary_edges == open - 4);
  REQUIRE(self_intersections(mesh).empty());
}

TEST_CASE("a hole that every fill crosses something in stays, and where that is is told") {
  TriangleMesh mesh = sheet_with_saddle_hole();
  add_obstacle(mesh, {0.5, 0.5, 0.0}, 0.1);
  add_obstacle(mesh, {0.5, 0.5, kRise}, 0.1);
  const TriangleMesh before = mesh;
  const VerifiedFills fills = fill_the_hole(mesh);
  REQUIRE(fills.filled_holes == 0);
  REQUIRE(fills.rejected == std::vector<std::size_t>{0});
  REQUIRE(!fills.obstructed.empty());
  REQUIRE(mesh == before);
}

}  // namespace
}  // namespace rangezip
