#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/finish/seen_points.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// Flags the faces, of those asked, of which their own points look out of the back
/// (VotesNear::look_toward()). O(faces + points).
/// @param radius model units, positive: around its centroid points are a face's own
/// @return per face of the mesh; without votes all 0
[[nodiscard]] std::vector<std::uint8_t> inside_out_faces(const TriangleMesh& mesh,
                                                         std::span<const std::uint32_t> faces,
                                                         const SeenPoints& seen, double radius);

}  // namespace rangezip
