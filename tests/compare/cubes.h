#pragma once

#include <cstdint>

#include "core/mesh/triangle_mesh.h"
#include "tests/support/shapes.h"

/// Meshes with closed-form answers, for the judges' own tests.
namespace rangezip::test {

/// The closed cube with sides of 2 half_side about `center`, faces outward, two a side; the last
/// two are the side of greatest x.
inline TriangleMesh cube(double half_side, const Vec3& center = Vec3{0.0}) {
  return shapes::to_mesh(shapes::box(center - half_side, center + half_side));
}

/// Both meshes as one, not joined.
inline TriangleMesh together(TriangleMesh a, const TriangleMesh& b) {
  const auto offset = static_cast<std::uint32_t>(a.positions.size());
  a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
  for (const Triangle& t : b.triangles) {
    a.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  }
  return a;
}

/// `columns` x 1 squares of side 1 in the plane z = 0, two triangles each: square i has the
/// triangles 2 i (right of its diagonal) and 2 i + 1 (left of it).
inline TriangleMesh strip(std::uint32_t columns) {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i <= columns; ++i) {
    mesh.positions.push_back({static_cast<double>(i), 0.0, 0.0});
    mesh.positions.push_back({static_cast<double>(i), 1.0, 0.0});
  }
  for (std::uint32_t i = 0; i < columns; ++i) {
    mesh.triangles.push_back({2 * i, 2 * i + 2, 2 * i + 3});
    mesh.triangles.push_back({2 * i, 2 * i + 3, 2 * i + 1});
  }
  return mesh;
}

/// A point in the cube of side 2 about the origin.
inline Vec3 random_point(shapes::Random& random) {
  return {random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-1.0, 1.0)};
}

}  // namespace rangezip::test
