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

}  // namespace
}  // namespace rangezip
