#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/mesh/halfedge.h"
#include "core/stitch/image_plane.h"

namespace rangezip {

/// A part of a mesh, cut out for surgery in the image plane. Faces know their neighbours, vertices
/// their images. Private to the sources of the library, as core/mesh/halfedge.h is.
struct SheetMesh {
  HalfedgeMesh mesh;
  std::vector<GridPoint> points;               ///< of its vertices; empty before set_image()
  std::vector<double> depths;                  ///< of its vertices; empty before set_image()
  std::vector<std::uint32_t> vertex_in_whole;  ///< index of each vertex in the whole mesh
  std::vector<std::uint32_t> face_in_whole;    ///< where each face was cut out: those of cut_out()
                                               ///< ascending, then those made by splitting one

  using VertexHandle = HalfedgeMesh::VertexHandle;
  using HalfedgeHandle = HalfedgeMesh::HalfedgeHandle;
  using FaceHandle = HalfedgeMesh::FaceHandle;

  [[nodiscard]] const GridPoint& point(VertexHandle v) const {
    return points[static_cast<std::size_t>(v.idx())];
  }
  [[nodiscard]] double depth(VertexHandle v) const {
    return depths[static_cast<std::size_t>(v.idx())];
  }
  [[nodiscard]] std::array<VertexHandle, 3> corners(FaceHandle f) const;

  /// Twice the signed area in the image: positive if the face looks at the viewer, 0 if a part of
  /// it has no image.
  [[nodiscard]] std::int64_t area(FaceHandle f) const;

  /// Whether p lies left of the directed edge (positive), right, or on its line (0).
  [[nodiscard]] std::int64_t side(HalfedgeHandle e, const GridPoint& p) const {
    return orientation(point(mesh.from_vertex_handle(e)), point(mesh.to_vertex_handle(e)), p);
  }
};

/// Cuts out the faces that are marked (1). O(faces of the mesh), about 0.5 us each marked one.
/// @throws TopologyError if these are not oriented and manifold
[[nodiscard]] SheetMesh cut_out(const TriangleMesh& mesh, const std::vector<std::uint8_t>& marked);

/// @param image of the whole mesh
void set_image(SheetMesh& sheet, const ImagePlane& image);

/// The faces that are left, with the vertex indices of the whole mesh.
[[nodiscard]] std::vector<Triangle> faces_in_whole(const SheetMesh& sheet);

}  // namespace rangezip
