#pragma once

#include <cstddef>

#include "core/base/progress.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// The topology of a mesh in counts, for any mesh whose indices are in range. A face with a
/// repeated corner counts in `faces` and `degenerate_faces` only. O(faces).
struct MeshReport {
  std::size_t vertices = 0;  ///< used by a face
  std::size_t faces = 0;
  std::size_t edges = 0;
  std::size_t components = 0;  ///< joined over shared edges
  std::size_t boundary_edges = 0;
  std::size_t boundary_loops = 0;
  double longest_loop = 0.0;             ///< model units
  std::size_t nonmanifold_edges = 0;     ///< with three or more faces
  std::size_t misoriented_edges = 0;     ///< two faces that run along it in the same direction
  std::size_t nonmanifold_vertices = 0;  ///< with more than one fan of faces
  std::size_t degenerate_faces = 0;      ///< a repeated corner, or no area
  std::ptrdiff_t euler = 0;              ///< V - E + F over used vertices

  [[nodiscard]] bool is_manifold() const noexcept {
    return nonmanifold_edges == 0 && nonmanifold_vertices == 0 && misoriented_edges == 0;
  }
};

/// @throws Cancelled if `progress` says so.
[[nodiscard]] MeshReport report_mesh(const TriangleMesh& mesh, const Progress& progress = {});

/// Throws if the mesh breaks a rule that every operation here keeps: an index out of range, a
/// coordinate that is not finite, a repeated corner, a directed edge in two faces, a vertex with
/// two fans. For tests and for input from outside; O(faces).
/// @throws TopologyError naming the rule and the element.
/// @throws Cancelled if `progress` says so.
void check_mesh(const TriangleMesh& mesh, const Progress& progress = {});

}  // namespace rangezip
