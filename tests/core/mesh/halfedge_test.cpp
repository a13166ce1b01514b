#include "core/mesh/halfedge.h"

#include <catch2/catch.hpp>

#include "core/base/error.h"
#include "core/mesh/mesh_report.h"
#include "tests/support/shapes.h"

using namespace rangezip;

TEST_CASE("a mesh comes back from half-edges with its numbers", "[mesh]") {
  TriangleMesh mesh = shapes::to_mesh(shapes::torus(1.0, 0.4, 24));
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v)
    mesh.sources.push_back({v, 7});
  const TriangleMesh back = mesh_from_halfedge(halfedge_from_mesh(mesh), mesh.sources);
  CHECK(back.positions == mesh.positions);
  CHECK(back.sources == mesh.sources);
  REQUIRE(back.triangles.size() == mesh.triangles.size());
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    Triangle turned = back.triangles[f];  // may start at another corner
    while (turned[0] != mesh.triangles[f][0])
      turned = {turned[1], turned[2], turned[0]};
    CHECK(turned == mesh.triangles[f]);
  }
}

TEST_CASE("deleted faces and vertices without a face do not come back", "[mesh]") {
  const TriangleMesh mesh{.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {5, 5, 5}},
                          .triangles = {{0, 1, 2}, {0, 2, 3}}};
  HalfedgeMesh halfedges = halfedge_from_mesh(mesh);
  halfedges.delete_face(HalfedgeMesh::FaceHandle(1), false);
  const TriangleMesh back = mesh_from_halfedge(halfedges);
  CHECK(back.triangles.size() == 1);
  CHECK(back.positions.size() == 3);
}

TEST_CASE("halfedge_from_mesh refuses what is not oriented and manifold", "[mesh]") {
  TriangleMesh mesh{.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}},
                    .triangles = {{0, 1, 2}, {0, 2, 3}}};
  const Triangle bad = GENERATE(Triangle{0, 2, 4},    // a third face at an edge
                                Triangle{0, 1, 4},    // runs along an edge in the same direction
                                Triangle{0, 0, 4},    // a repeated corner
                                Triangle{0, 4, 17});  // no such vertex
  mesh.triangles.push_back(bad);
  CHECK_THROWS_AS(halfedge_from_mesh(mesh), TopologyError);
}
