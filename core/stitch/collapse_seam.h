#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// Last step of zippering: collapses edges shorter than `min_length` (model units) that end in a
/// vertex of the seam, onto that vertex where it may stay. An edge stays if the collapse would
/// change the topology, move the boundary, flatten a face, or turn one by more than 60 degrees
/// [Kobbelt, Botsch 2000, 4.4]. Vertices keep their numbers.
/// @param seam one per vertex: 1 on the seam
/// @return how many were collapsed
/// @pre the mesh is oriented and manifold, and stays so
std::size_t collapse_short_seam_edges(TriangleMesh& mesh, const std::vector<std::uint8_t>& seam,
                                      double min_length);

}  // namespace rangezip
