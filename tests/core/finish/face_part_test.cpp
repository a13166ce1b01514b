#include "core/finish/face_part.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/mesh/mesh_report.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

std::vector<Triangle> sorted_faces(std::vector<Triangle> faces) {
  std::sort(faces.begin(), faces.end());
  return faces;
}

std::vector<std::uint8_t> left_half(const TriangleMesh& mesh) {
  std::vector<std::uint8_t> flags;
  for (const Triangle& t : mesh.triangles)
    flags.push_back(mesh.positions[t[0]].x < 0.0 ? 1 : 0);
  return flags;
}

TEST_CASE("a part of a mesh that is put back unchanged leaves the same faces at the same places",
          "[finish]") {
  const TriangleMesh before = shapes::square_sheet(8);
  TriangleMesh mesh = before;
  FacePart part = face_part(mesh, left_half(mesh));
  REQUIRE(!part.faces.empty());
  REQUIRE(part.faces.size() < mesh.triangles.size());
  REQUIRE(part.mesh.positions.size() == part.vertices.size());
  put_back(std::move(part), mesh);
  CHECK(mesh.positions == before.positions);
  CHECK(sorted_faces(mesh.triangles) == sorted_faces(before.triangles));
}

TEST_CASE("what is done to a part is done to the whole, new vertices included", "[finish]") {
  TriangleMesh mesh = shapes::square_sheet(8);
  const std::size_t vertices = mesh.positions.size(), faces = mesh.triangles.size();
  FacePart part = face_part(mesh, left_half(mesh));
  // The first face of the part becomes three around its centre.
  const auto [a, b, c] = part.mesh.triangles[0];
  const auto& p = part.mesh.positions;
  const Vec3 centre = (p[a] + p[b] + p[c]) / 3.0;
  const auto tip = static_cast<std::uint32_t>(p.size());
  part.mesh.positions.push_back(centre);
  part.mesh.triangles[0] = {a, b, tip};
  part.mesh.triangles.push_back({b, c, tip});
  part.mesh.triangles.push_back({c, a, tip});
  put_back(std::move(part), mesh);
  REQUIRE(mesh.positions.size() == vertices + 1);
  CHECK(mesh.positions.back() == centre);
  CHECK(mesh.triangles.size() == faces + 2);
  CHECK(report_mesh(mesh).is_manifold());
  CHECK(report_mesh(mesh).euler == 1);
}

TEST_CASE("vertices within so many edges of a face are those of that many rings", "[finish]") {
  const TriangleMesh mesh = shapes::square_sheet(10);
  const std::vector<std::uint32_t> one{110};
  const auto count = [&](int edges) {
    const std::vector<std::uint8_t> flags = vertices_within(mesh, one, edges);
    return std::count(flags.begin(), flags.end(), 1);
  };
  CHECK(count(0) == 3);
  // On the regular lattice each ring around a triangle is a hexagon with three corners cut.
  CHECK(count(1) == 12);
  CHECK(count(2) == 27);
  CHECK(count(100) == static_cast<std::ptrdiff_t>(mesh.positions.size()));
  const FacePart part = part_within(mesh, one, 0);
  CHECK(part.faces.size() == 13);  // it and the twelve that touch it
}

}  // namespace
}  // namespace rangezip
