#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/finish/boundary_loops.h"
#include "core/finish/corner_table.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

struct EarFills {
  std::size_t faces = 0;            ///< that came, the last ones of the mesh
  std::vector<std::uint32_t> left;  ///< vertices of the loops that stay
};

/// Closes loops as far as that crosses nothing: ear by ear, a face between three vertices of a loop
/// in a row, and what would cross the mesh or another ear is never made. The ear with the shortest
/// new edge comes first, of 8 h at most, where each unit of the cosine by which the ear turns from
/// the faces beside it counts as h. So bays are filled along their side of a blade, and then its
/// sides are joined from the ends of the slit. What cannot be closed stays a loop, a shorter one.
/// The mesh stays manifold, and without self-intersections. O(n^2) for loops of n edges, and
/// O(faces) for those around.
/// @param loops of the mesh, each up to 2,000 edges; longer ones stay
/// @param pixel_size h, model units; positive
/// @pre the loops are of `table`, and no face beside them has gone since; others may have come
EarFills fill_by_ears(TriangleMesh& mesh, const CornerTable& table,
                      const std::vector<BoundaryLoop>& loops, double pixel_size);

}  // namespace rangezip
