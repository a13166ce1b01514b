#include "core/finish/removed_faces.h"

#include <catch2/catch.hpp>
#include <vector>

#include "core/finish/hole_filling.h"
#include "core/mesh/mesh_report.h"
#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

/// Drops faces by their centroids; vertices keep their numbers.
template <class Where>
void cut(TriangleMesh& mesh, const Where& where) {
  std::erase_if(mesh.triangles, [&](const Triangle& t) {
    return where((mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3.0);
  });
}

TriangleMesh ball_with_hole(double radius) {
  TriangleMesh mesh = testing::sphere(12);
  cut(mesh, [&](const Vec3& p) { return glm::length(p - Vec3(0, 0, 1)) < radius; });
  return mesh;
}

}  // namespace

TEST_CASE("what was taken around an open hole comes back, all of it", "[finish]") {
  const TriangleMesh start = ball_with_hole(0.3);
  const RemovedFaces removed(start);
  TriangleMesh wider = start;
  cut(wider, [](const Vec3& p) { return p.z > 0.2; });
  REQUIRE(wider.triangles.size() < start.triangles.size());
  const std::size_t count = removed.put_back(wider);
  CHECK(wider.triangles.size() == start.triangles.size());
  CHECK(count > 0);
  remove_unused_vertices(wider);
  CHECK(report_mesh(wider).is_manifold());
  CHECK(report_mesh(wider).boundary_loops == 1);
}

TEST_CASE("what a fill has replaced does not come back", "[finish]") {
  const TriangleMesh start = testing::sphere(12);
  const RemovedFaces removed(start);
  TriangleMesh mesh = start;
  cut(mesh, [](const Vec3& p) { return p.z > 0.8; });
  const CornerTable table(mesh.triangles, mesh.positions.size());
  const std::vector<BoundaryLoop> loops = boundary_loops(table);
  REQUIRE(loops.size() == 1);
  CHECK(removed.behind(table, loops[0]).size() == start.triangles.size() - mesh.triangles.size());
  append_fill(mesh, fill_loop(mesh.positions, table, loops[0], FillShape::flat, 0.1),
              mesh.positions.size());
  const std::size_t filled = mesh.triangles.size();
  CHECK(removed.put_back(mesh) == 0);
  CHECK(mesh.triangles.size() == filled);
}

TEST_CASE("behind a loop lies what hangs together with it, and nothing of another hole",
          "[finish]") {
  const TriangleMesh start = testing::sphere(12);
  const RemovedFaces removed(start);
  TriangleMesh mesh = start;
  cut(mesh, [](const Vec3& p) { return p.z > 0.8 || p.z < -0.6; });
  const CornerTable table(mesh.triangles, mesh.positions.size());
  for (const BoundaryLoop& loop : boundary_loops(table)) {
    const bool is_upper = mesh.positions[table.vertex(loop.corners[0])].z > 0.0;
    for (const Triangle& face : removed.behind(table, loop)) {
      for (const std::uint32_t v : face)
        CHECK((start.positions[v].z > 0.0) == is_upper);
    }
  }
}

TEST_CASE("a fill stands for a hole whose rim it cuts off a little, not for a finger", "[finish]") {
  // Below the fill of a square, places that it closes over: a flat ground and a ridge in it.
  const double h = 0.1;
  const TriangleMesh fill{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  const double ridge_height = GENERATE(1.0, 5.0);      // in h
  const std::size_t ridge_places = GENERATE(3U, 60U);  // of a hundred
  std::vector<Vec3> places;
  for (std::size_t i = 0; i < 100; ++i) {
    const double height = i < ridge_places ? ridge_height * h : 0.0;
    places.emplace_back(0.005 * static_cast<double>(i), 0.5, height);
  }
  CHECK(stands_for(fill, places, h) == (ridge_height < 1.5 || ridge_places < 5));
}

}  // namespace rangezip
