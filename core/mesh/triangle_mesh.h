#pragma once

#include <cstdint>
#include <vector>

#include "core/base/geometry.h"
#include "core/raster/draw_item.h"

namespace rangezip {

/// Where a vertex comes from: the primitive of the scene that won its pixel (Scene::number_of), and
/// the number of the scan. kNoPrimitive / kNoView for vertices that a fill or a finish made.
/// A decimated patch also says how densely the surface was sampled, which its faces do not show.
struct VertexSource {
  static constexpr std::uint32_t kNoView = 0xffff'ffffU;
  PrimitiveId primitive = kNoPrimitive;
  std::uint32_t view = kNoView;
  float sampling =
      0.0F;  ///< sample_quality() of a decimated patch, model units; 0: as the faces are

  friend bool operator==(const VertexSource&, const VertexSource&) = default;
};

/// An indexed triangle mesh, the form in which stages hand meshes to each other, draw and store
/// them: world positions in double and corners counter-clockwise as seen from outside. The index
/// of a triangle is its PrimitiveId when the mesh is drawn. Surgery that needs neighbours builds
/// them (core/mesh/halfedge.h, core/mesh/edge_map.h).
struct TriangleMesh {
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
  std::vector<VertexSource> sources;  ///< one per position, or empty: not recorded

  [[nodiscard]] bool empty() const noexcept { return triangles.empty(); }
  friend bool operator==(const TriangleMesh&, const TriangleMesh&) = default;
};

/// Unit normal of a face, counter-clockwise; zero where it has no area.
[[nodiscard]] inline Vec3 unit_normal(const std::vector<Vec3>& positions, const Triangle& face) {
  return unit_normal(positions[face[0]], positions[face[1]], positions[face[2]]);
}

[[nodiscard]] inline Vec3 centroid_of(const std::vector<Vec3>& positions, const Triangle& face) {
  return (positions[face[0]] + positions[face[1]] + positions[face[2]]) / 3.0;
}

/// In square units of the positions.
[[nodiscard]] inline double area_of_face(const std::vector<Vec3>& positions, const Triangle& face) {
  return 0.5 * glm::length(area_vector(positions[face[0]], positions[face[1]], positions[face[2]]));
}

/// Box around all positions.
[[nodiscard]] Box bounds_of(const TriangleMesh& mesh);

/// The smallest box around a triangle of a mesh.
[[nodiscard]] inline Box box_of(const TriangleMesh& mesh, const Triangle& triangle) noexcept {
  Box box;
  for (const std::uint32_t corner : triangle)
    box.add(mesh.positions[corner]);
  return box;
}

/// Longest side of a triangle, model units: the paper's quality of an old triangle
/// [Kobbelt, Botsch 2000, 4.3].
[[nodiscard]] double longest_side(const TriangleMesh& mesh, const Triangle& triangle);

/// Quality of the samples that a triangle stands for, model units, small is good: its longest side,
/// or what its three vertices remember of their sampling if that is finer.
[[nodiscard]] double sampling_of(const TriangleMesh& mesh, const Triangle& triangle);

/// Drops the marked (1) triangles, keeping the order of the others. @pre one mark per triangle
void remove_triangles(std::vector<Triangle>& triangles, const std::vector<std::uint8_t>& marked);

/// Drops the marked (1) positions, keeping the order of the others.
/// @pre one mark per position; no triangle uses a marked one
void remove_vertices(TriangleMesh& mesh, const std::vector<std::uint8_t>& marked);

/// The same mesh with its vertices in order along a curve (order_along_curve()), and the triangles
/// in that of their first vertices: walks over its neighbourhoods then stay in the processor's
/// cache, which saves a tenth of a whole run. @pre all positions are finite. O(n).
void sort_along_curve(TriangleMesh& mesh);

/// Drops positions that no triangle uses, keeping the order of the others.
void remove_unused_vertices(TriangleMesh& mesh);

}  // namespace rangezip
