#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/finish/corner_table.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

struct DroppedComponents {
  std::size_t components = 0;
  std::size_t faces = 0;
};

struct SmallPieceOptions {
  std::size_t min_faces = 0;  ///< pieces with fewer are small; 0: nothing is dropped
  double pixel_size = 0.0;    ///< h, model units; positive
};

/// Drops the components (joined over shared edges) with fewer than `min_faces` faces, and shreds:
/// open ones with less than a two-hundredth of the faces of the largest component, which are
/// pieces of walls in pockets that no view connects. A sheet has no pockets if its area vector is
/// at least half its area (it is flatter than half a sphere): beside it they are things of their
/// own, such as roofs over a ground, and stay. A component of 40 faces that stands apart, by 3 h
/// from all with `min_faces` and a twentieth of the largest one's faces, is a small body or one
/// side of it, and stays; and so does one with `min_faces`, 1.25 h apart, that is nearly closed
/// around its inside. So does the largest one (the earliest of equals). Positions stay. Cost:
/// linear.
/// @param table of the mesh, as it is before
/// @param component of each face: components_of(table)
/// @pre oriented and manifold
DroppedComponents drop_small_components(TriangleMesh& mesh, const CornerTable& table,
                                        const std::vector<std::uint32_t>& component,
                                        const SmallPieceOptions& options);

}  // namespace rangezip
