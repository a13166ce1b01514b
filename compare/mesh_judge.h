#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace rangezip::compare {

/// CGAL's verdict on a mesh: shares no code with report_mesh() and self_intersections(), so the
/// two can be held against each other. Members after `is_manifold` mean nothing without it.
struct MeshVerdict {
  std::size_t vertices = 0;  ///< used by a face
  std::size_t faces = 0;
  bool is_manifold = false;  ///< an edge has at most two faces, which run along it in opposite
                             ///< directions, and a vertex one fan
  std::size_t components = 0;
  std::size_t boundary_loops = 0;
  std::ptrdiff_t euler = 0;            ///< V - E + F
  std::optional<double> volume;        ///< of a closed mesh, model units^3; positive: the faces
                                       ///< look outward
  std::size_t degenerate_faces = 0;    ///< collinear corners, decided exactly
  std::size_t self_intersections = 0;  ///< pairs of faces, degenerate ones not counted

  /// A surface that any program accepts.
  [[nodiscard]] bool is_clean() const noexcept {
    return is_manifold && degenerate_faces == 0 && self_intersections == 0;
  }
};

/// Judges topology by Polygon_mesh_processing::is_polygon_soup_a_polygon_mesh and geometry with
/// exact predicates. O(n log n).
/// @throws TopologyError if a corner index is out of range or a used position is not finite.
[[nodiscard]] MeshVerdict judge_mesh(const TriangleMesh& mesh);

/// Polygon_mesh_processing::self_intersections: pairs of triangles, lower index first, sorted. As
/// there, a degenerate triangle is reported as a pair with itself and with no other.
/// @throws TopologyError if the mesh is not manifold and consistently oriented, a corner index is
///     out of range, or a used position is not finite.
[[nodiscard]] std::vector<std::pair<std::uint32_t, std::uint32_t>> cgal_self_intersections(
    const TriangleMesh& mesh);

}  // namespace rangezip::compare
