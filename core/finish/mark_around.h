#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// Flags the places that lie in or on the box around a pair of faces; what has a flag keeps it.
/// O(places log pairs) where few of the boxes overlap.
/// @param mesh has these faces
/// @param marked of the places, as many
/// @pre all positions of the mesh are finite
void mark_around(const TriangleMesh& mesh,
                 const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs,
                 const std::vector<Vec3>& places, std::vector<std::uint8_t>& marked);

}  // namespace rangezip
