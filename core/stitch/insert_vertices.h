#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/mesh/triangle_mesh.h"
#include "core/stitch/patch_sheet.h"
#include "core/stitch/sheet_mesh.h"

namespace rangezip {

/// A vertex of the patch's boundary to be put into the old surface.
struct BoundaryVertex {
  std::uint32_t index = 0;  ///< in the whole mesh, where it has its position already
  Pixel pixel;
  Vec3 position{0.0};
  double depth = 0.0;
  /// Model units: it is put into no face farther than this.
  double reach = std::numeric_limits<double>::infinity();
};

struct InsertedVertices {
  /// For each vertex its handle in the sheet; invalid where the sheet has no place for it.
  std::vector<SheetMesh::VertexHandle> handles;
  /// The face of the whole mesh that it was put into, where its handle is valid.
  std::vector<std::uint32_t> faces;
  std::size_t inserted = 0;  ///< valid handles
};

/// Model units.
[[nodiscard]] double distance_to_face(const TriangleMesh& mesh, std::uint32_t face,
                                      const Vec3& point);

/// First step of zippering: every boundary vertex is put into the old face on which it lies in the
/// image: into its inside (one face becomes three), onto an edge (two become four), or it takes the
/// place of an old vertex that has the same image; that one moves to its position and keeps its
/// index. The face is found by a walk from the corresponding one, since that was found on the
/// rasterizer's coarser grid. A vertex stays out where the walk leaves the sheet, where the surface
/// found is farther than 1.5 `band` (pixel sides times stretch) in depth, and where the face is
/// farther than its reach: beside a crease or a step the face in sight is not the nearest one
/// [Kobbelt, Botsch 2000, 4.4].
/// @param old_surface the whole mesh, as it was cut out
/// @param faces where each walk starts: the corresponding face in the sheet; invalid: none
[[nodiscard]] InsertedVertices insert_boundary_vertices(
    SheetMesh& sheet, const TriangleMesh& old_surface, std::span<const BoundaryVertex> vertices,
    std::span<const SheetMesh::FaceHandle> faces, const PatchSheet& patch, double band);

}  // namespace rangezip
