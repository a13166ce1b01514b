#include "core/mesh/outgoing_edges.h"

#include <catch2/catch.hpp>

#include "core/mesh/edge_map.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

TEST_CASE("OutgoingEdges tells the face of every directed edge as an EdgeMap does", "[mesh]") {
  TriangleMesh mesh = shapes::to_mesh(shapes::sphere(1.0, 12));
  mesh.triangles.push_back(mesh.triangles.front());  // of two faces the first counts
  const OutgoingEdges edges(mesh);
  EdgeMap expected;
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    const Triangle& t = mesh.triangles[f];
    for (std::size_t k = 0; k < 3; ++k)
      expected.insert(t[k], t[(k + 1) % 3], f);
  }
  const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::uint32_t from = 0; from < vertices; ++from) {
    for (std::uint32_t to = 0; to < vertices; ++to)
      REQUIRE(edges.find(from, to) == expected.find(from, to));
  }
}

TEST_CASE("OutgoingEdges knows none at a vertex without faces", "[mesh]") {
  TriangleMesh mesh;
  mesh.positions.resize(4, Vec3{0.0});
  mesh.triangles.push_back({0, 1, 2});
  const OutgoingEdges edges(mesh);
  CHECK(edges.find(2, 0) == 0);
  CHECK(edges.find(0, 2) == OutgoingEdges::kNone);
  CHECK(edges.find(3, 0) == OutgoingEdges::kNone);
}

}  // namespace
}  // namespace rangezip
