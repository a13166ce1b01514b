#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "core/base/cubes.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// Tells of a mesh that grows face by face whether another face would cross it, fold onto it, or
/// touch it other than in what they share (core/mesh/triangle_overlap.h). Faces are listed in the
/// cubes of a grid that their boxes meet. Cost: constant for faces of about a cube's side.
class CrossingGuard {
 public:
  /// @param mesh its faces are watched from the beginning; must outlive the guard
  /// @param side of the cubes, model units; positive
  CrossingGuard(const TriangleMesh& mesh, double side);

  /// Watches a face that has come.
  void add(std::uint32_t face);

  /// Whether a face between vertices of the mesh crosses one that is watched.
  /// @pre it has an area
  [[nodiscard]] bool would_cross(const Triangle& face) const;

 private:
  template <class Visit>
  void for_each_cube(const Box& box, const Visit& visit) const;

  const TriangleMesh& mesh_;
  double side_;
  std::unordered_map<Cube, std::vector<std::uint32_t>, CubeHash> faces_of_;
};

}  // namespace rangezip
