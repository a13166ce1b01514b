#include "core/mesh/face_changes.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

#include "core/base/error.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

TEST_CASE("faces that stay are no changes, wherever they stand and begin") {
  const TriangleMesh before = shapes::to_mesh(shapes::sphere(1.0));
  TriangleMesh after = before;
  std::reverse(after.triangles.begin(), after.triangles.end());
  for (Triangle& t : after.triangles)
    std::rotate(t.begin(), t.begin() + 1, t.end());
  const FaceChanges changes = find_face_changes(before, after);
  REQUIRE(changes.made.empty());
  REQUIRE(changes.gone.empty());
}

TEST_CASE("a vertex that moves changes the faces around it, before and after") {
  const TriangleMesh before = shapes::to_mesh(shapes::sphere(1.0));
  TriangleMesh after = before;
  const std::uint32_t moved = before.triangles[7][0];
  after.positions[moved] *= 1.1;
  const auto around = static_cast<std::size_t>(std::count_if(
      before.triangles.begin(), before.triangles.end(),
      [&](const Triangle& t) { return std::find(t.begin(), t.end(), moved) != t.end(); }));
  const FaceChanges changes = find_face_changes(before, after);
  REQUIRE(changes.made.size() == around);
  REQUIRE(changes.gone.size() == around);
}

TEST_CASE("new faces are told whatever the numbers of vertices") {
  const TriangleMesh before = shapes::to_mesh(shapes::sphere(1.0));
  TriangleMesh after = before;
  after.positions.insert(after.positions.begin(), Vec3(5.0));  // all others get the next number
  for (Triangle& t : after.triangles) {
    for (std::uint32_t& v : t)
      ++v;
  }
  REQUIRE(find_new_faces(before, after).empty());
  const Triangle split = after.triangles[11];
  after.triangles[11] = {split[0], split[1], 0};
  after.triangles.push_back({split[1], split[2], 0});
  after.triangles.push_back({split[2], split[0], 0});
  const auto last = static_cast<std::uint32_t>(after.triangles.size());
  REQUIRE(find_new_faces(before, after) == std::vector<std::uint32_t>{11, last - 2, last - 1});
}

TEST_CASE("vertices with new numbers are no meshes to compare") {
  const TriangleMesh before = shapes::to_mesh(shapes::sphere(1.0));
  TriangleMesh after = before;
  after.triangles.pop_back();
  after.positions.pop_back();
  REQUIRE_THROWS_AS(find_face_changes(before, after), InvalidArgument);
}

}  // namespace
}  // namespace rangezip
