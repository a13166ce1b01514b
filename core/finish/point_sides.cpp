#include "core/finish/point_sides.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "core/base/cubes.h"
#include "core/finish/face_grid.h"
#include "core/finish/triangle_shape.h"

namespace rangezip {
namespace {

constexpr double kCube = 2.0;          ///< in h
constexpr double kReach = 1.0;         ///< in h, of a point from its face
constexpr double kCellPerReach = 2.0;  ///< of the grid in which faces are looked for
/// Cosine between faces that are on different sides. Directions are rounded by up to 30 degrees.
constexpr double kOtherSide = -0.4;

/// Directions rounded to the 26 neighbours of a cube; a bit each.
using Directions = std::uint32_t;

constexpr int kNeighbors = 27;  ///< with the cube itself, which is no direction

Vec3 neighbor(int k) {
  return Vec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
}

int rounded_direction(const Vec3& unit) {
  constexpr double kStep = 0.3827;  // sine of 22.5 degrees
  int k = 0;
  for (int axis = 2; axis >= 0; --axis)
    k = 3 * k + (unit[axis] > kStep ? 2 : unit[axis] < -kStep ? 0 : 1);
  return k;
}

/// For each direction those on the other side.
std::array<Directions, kNeighbors> other_sides() {
  std::array<Directions, kNeighbors> others{};
  for (int i = 0; i < kNeighbors; ++i) {
    for (int j = 0; j < kNeighbors; ++j) {
      const Vec3 a = neighbor(i), b = neighbor(j);
      if (glm::dot(a, b) < kOtherSide * glm::length(a) * glm::length(b))
        others[static_cast<std::size_t>(i)] |= Directions{1} << j;
    }
  }
  return others;
}

using CubeMap = std::unordered_map<Cube, Directions, CubeHash>;
using CubeSet = std::unordered_set<Cube, CubeHash>;

/// Which way faces do, cube by cube, with the cubes around.
CubeMap directions_around(const TriangleMesh& mesh, const std::vector<Vec3>& normals, double side) {
  CubeMap own;
  for (std::size_t f = 0; f < normals.size(); ++f) {
    own[cube_of(mesh.positions[mesh.triangles[f][0]], side)] |= Directions{1}
                                                                << rounded_direction(normals[f]);
  }
  CubeMap around;
  for (const auto& [cube, directions] : own) {
    for_each_cube_around(cube, [&, mask = directions](const Cube& near) { around[near] |= mask; });
  }
  return around;
}

/// Leaves the cubes around which faces are on both sides.
void keep_two_sided(CubeMap& cubes) {
  const std::array<Directions, kNeighbors> others = other_sides();
  std::erase_if(cubes, [&](const auto& entry) {
    for (std::size_t k = 0; k < others.size(); ++k) {
      if ((entry.second >> k & 1U) != 0 && (entry.second & others[k]) != 0) return false;
    }
    return true;
  });
}

std::vector<Vec3> normals_of(const TriangleMesh& mesh) {
  std::vector<Vec3> normals;
  normals.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    normals.push_back(
        unit_or_z(area_vector(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]])));
  }
  return normals;
}

}  // namespace

void tell_sides(PointGrid& cloud, const TriangleMesh& mesh, double pixel_size) {
  const double side = kCube * pixel_size;
  std::vector<Vec3> normals = normals_of(mesh);
  CubeMap cubes = directions_around(mesh, normals, side);
  keep_two_sided(cubes);
  if (cubes.empty()) return;
  CubeSet with_faces;  // a point's nearest face may begin in the next cube
  for (const auto& [cube, directions] : cubes)
    for_each_cube_around(cube, [&](const Cube& near) { with_faces.insert(near); });
  TriangleMesh part{mesh.positions, {}, {}};
  std::vector<Vec3> part_normals;
  for (std::size_t f = 0; f < normals.size(); ++f) {
    if (!with_faces.contains(cube_of(mesh.positions[mesh.triangles[f][0]], side))) continue;
    part.triangles.push_back(mesh.triangles[f]);
    part_normals.push_back(normals[f]);
  }
  const double reach = kReach * pixel_size;
  const FaceGrid faces(part, kCellPerReach * reach);
  cloud.note_facings([&](const Vec3& point) {
    if (!cubes.contains(cube_of(point, side))) return Vec3(0.0);
    const std::uint32_t face = faces.nearest_face(point, reach);
    return face == CornerTable::kNone ? Vec3(0.0) : part_normals[face];
  });
}

}  // namespace rangezip
