#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// Flags the faces, of those asked, whose front is inside of a body: from their centroids rays go
/// both ways along the three axes, unless they graze the face (over 72 degrees from its normal);
/// one in front of the face goes through an even number of faces if that is outside, one behind it
/// through an odd number, and most of them decide [Nooruddin, Turk 2003]. So it does not matter
/// which way the other faces look. Where the mesh has large holes it means little.
/// O(faces of the mesh), and for each that is asked those that rays along the axes go through.
/// @return per face of the mesh
/// @pre all positions are finite
[[nodiscard]] std::vector<std::uint8_t> faces_facing_inwards(const TriangleMesh& mesh,
                                                             std::span<const std::uint32_t> faces);

}  // namespace rangezip
