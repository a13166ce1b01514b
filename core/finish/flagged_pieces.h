#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// Faces with a flag that hang together by their edges.
struct FlaggedPiece {
  double area = 0.0;  ///< square model units
  double rim = 0.0;   ///< length of the edges to faces without, model units
};

/// Clears the flags of pieces that are not kept. O(faces).
/// @param flags of faces, 0 or 1
/// @pre each directed edge once
void keep_pieces(const TriangleMesh& mesh, std::vector<std::uint8_t>& flags,
                 const std::function<bool(const FlaggedPiece&)>& is_kept);

}  // namespace rangezip
