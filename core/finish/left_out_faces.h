#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/finish/point_grid.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// Whether there is no point near a place of the surface because none was sampled there, and not
/// because of how they happen to lie: within 1.75 h and three spacings.
/// @param pixel_size h, model units
[[nodiscard]] bool is_left_out(const PointGrid& cloud, const Vec3& place, double pixel_size);

/// Flags the faces where the surface was not sampled: those that hang together and have no point
/// near their centroid or a corner (kFaceSupport, core/finish/unsupported_faces.h), if over 2 h^2
/// of them is left out. O(n log n) in the faces, and what their points cost.
/// @param position of a corner of the faces
/// @param pixel_size h, model units; positive
[[nodiscard]] std::vector<std::uint8_t> left_out_faces(
    const std::vector<Triangle>& faces, const std::function<Vec3(std::uint32_t)>& position,
    const PointGrid& cloud, double pixel_size);

}  // namespace rangezip
