#include "core/mesh/drawable.h"

#include <catch2/catch.hpp>

#include "tests/support/shapes.h"

namespace rangezip {
namespace {

TEST_CASE("a drawable mesh loses nothing to large coordinates", "[mesh]") {
  const Vec3 far{636763.0, 851298.0, 415.0};
  TriangleMesh mesh = shapes::to_mesh(shapes::sphere(1.0, 16));
  for (Vec3& p : mesh.positions)
    p += far;
  const DrawableMesh drawable(mesh);
  const DrawTriangles item = drawable.item(Facing::front);

  CHECK(item.facing == Facing::front);
  CHECK(item.first_id == 0);
  REQUIRE(item.positions.size() == mesh.positions.size());
  REQUIRE(item.triangles.size() == mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3 drawn(item.world_from_item * Vec4(Vec3(item.positions[i]), 1.0));
    // Floats of magnitude 1 round by at most 2^-25, doubles of magnitude 2^20 by 2^-33 each.
    REQUIRE(glm::length(drawn - mesh.positions[i]) < 2e-7);
  }
}

TEST_CASE("an empty mesh is drawable", "[mesh]") {
  const TriangleMesh mesh;
  CHECK(DrawableMesh(mesh).item().triangles.empty());
}

}  // namespace
}  // namespace rangezip
