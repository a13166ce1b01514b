#include "core/mesh/triangle_mesh.h"

#include <catch2/catch.hpp>

namespace rangezip {
namespace {

TEST_CASE("what is removed goes, and what stays keeps its order and its sources", "[mesh]") {
  TriangleMesh mesh;
  for (int i = 0; i < 6; ++i) {
    mesh.positions.emplace_back(i, i * i, 0.0);
    mesh.sources.push_back({.primitive = static_cast<PrimitiveId>(i)});
  }
  mesh.triangles = {{0, 1, 2}, {1, 3, 2}, {5, 4, 3}};
  const TriangleMesh whole = mesh;

  remove_triangles(mesh.triangles, {0, 0, 0});
  CHECK(mesh == whole);
  remove_triangles(mesh.triangles, {1, 0, 0});
  CHECK(mesh.triangles == std::vector<Triangle>{{1, 3, 2}, {5, 4, 3}});
  CHECK(mesh.positions == whole.positions);

  remove_unused_vertices(mesh);
  CHECK(mesh.triangles == std::vector<Triangle>{{0, 2, 1}, {4, 3, 2}});
  REQUIRE(mesh.positions.size() == 5);
  for (std::size_t v = 0; v < 5; ++v) {
    CHECK(mesh.positions[v] == whole.positions[v + 1]);
    CHECK(mesh.sources[v] == whole.sources[v + 1]);
  }
}

TEST_CASE("a mesh sorted along a curve is the same mesh", "[mesh]") {
  TriangleMesh mesh;
  for (const double x : {3.0, 1.0, 2.0, 0.0}) {
    mesh.positions.emplace_back(x, 0.0, 0.0);
    mesh.sources.push_back({.primitive = static_cast<PrimitiveId>(x)});
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}};
  sort_along_curve(mesh);
  for (std::uint32_t v = 0; v < 4; ++v) {
    CHECK(mesh.positions[v].x == v);
    CHECK(mesh.sources[v].primitive == v);
  }
  CHECK(mesh.triangles == std::vector<Triangle>{{1, 2, 0}, {3, 2, 1}});

  mesh.sources.clear();  // not recorded: stays so
  const TriangleMesh sorted = mesh;
  sort_along_curve(mesh);
  CHECK(mesh == sorted);
  TriangleMesh none;
  sort_along_curve(none);
  CHECK(none.empty());
}

}  // namespace
}  // namespace rangezip
