#pragma once

#include <cstdint>

#include "core/mesh/triangle_mesh.h"

/// Meshes with closed-form answers, for the judges' own tests.
namespace rangezip::test {

/// The closed cube with corners (+-half_side, +-half_side, +-half_side) about `center`, faces
/// outward, two a side.
inline TriangleMesh cube(double half_side, const Vec3& center = Vec3{0.0}) {
  TriangleMesh mesh;
  for (int corner = 0; corner < 8; ++corner) {
    const auto sign = [&](int axis) { return ((corner >> axis) & 1) != 0 ? 1.0 : -1.0; };
    mesh.positions.push_back(center + half_side * Vec3{sign(0), sign(1), sign(2)});
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
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

/// Deterministic numbers in [-1, 1) [Steele, Lea, Flood 2014].
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15U;
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31U);
  }
  double number() { return static_cast<double>(bits() >> 11U) * 0x1.0p-52 - 1.0; }
  Vec3 vector() { return {number(), number(), number()}; }

 private:
  std::uint64_t state_;
};

}  // namespace rangezip::test
