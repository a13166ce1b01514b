#include "core/finish/facing_inwards.h"

#include <catch2/catch.hpp>
#include <random>
#include <vector>

#include "tests/core/finish/all_faces.h"
#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

using testing::all_faces;

void turn(Triangle& face) {
  std::swap(face[1], face[2]);
}

/// A shell: a ball with a ball-shaped cavity, the faces of which look into the cavity; tilted, so
/// that no ray along an axis meets an edge.
TriangleMesh shell() {
  TriangleMesh mesh = testing::sphere(8);
  TriangleMesh cavity = testing::sphere(6);
  for (Vec3& p : cavity.positions)
    p *= 0.6;
  for (Triangle& t : cavity.triangles)
    turn(t);
  testing::append(mesh, cavity);
  for (Vec3& p : mesh.positions)
    p = {0.8 * p.x - 0.6 * p.y, 0.48 * p.x + 0.64 * p.y - 0.6 * p.z,
         0.36 * p.x + 0.48 * p.y + 0.8 * p.z};
  return mesh;
}

TEST_CASE("of a shell no face looks inwards but those that are turned, whichever these are") {
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  TriangleMesh mesh = shell();
  CHECK(faces_facing_inwards(mesh, all_faces(mesh)) ==
        std::vector<std::uint8_t>(mesh.triangles.size(), 0));
  std::vector<std::uint8_t> is_turned(mesh.triangles.size(), 0);
  for (std::size_t f = 0; f < is_turned.size(); ++f) {
    is_turned[f] = engine() % 3 == 0 ? 1 : 0;
    if (is_turned[f] != 0) turn(mesh.triangles[f]);
  }
  CHECK(faces_facing_inwards(mesh, all_faces(mesh)) == is_turned);
}

TEST_CASE("only faces that are asked for are flagged") {
  TriangleMesh mesh = shell();
  turn(mesh.triangles[3]);
  turn(mesh.triangles[5]);
  std::vector<std::uint8_t> expected(mesh.triangles.size(), 0);
  expected[5] = 1;
  CHECK(faces_facing_inwards(mesh, std::vector<std::uint32_t>{4, 5}) == expected);
}

TEST_CASE("a hole in a ball does not mislead most faces, nor any that is not across it") {
  TriangleMesh mesh = testing::sphere(12);
  testing::cut_where(mesh, [](const Vec3& p) { return p.z > 0.9; });
  const std::vector<std::uint8_t> flags = faces_facing_inwards(mesh, all_faces(mesh));
  for (std::size_t f = 0; f < flags.size(); ++f) {
    const Vec3 middle = centroid_of(mesh.positions, mesh.triangles[f]);
    CAPTURE(middle.x, middle.y, middle.z);
    if (middle.z > -0.85) CHECK(flags[f] == 0);
  }
}

TEST_CASE("a sheet has no inside") {
  TriangleMesh mesh = testing::sphere(6);
  testing::cut_where(mesh, [](const Vec3& p) { return p.z < 0.5; });
  CHECK(faces_facing_inwards(mesh, all_faces(mesh)) ==
        std::vector<std::uint8_t>(mesh.triangles.size(), 0));
}

}  // namespace
}  // namespace rangezip
