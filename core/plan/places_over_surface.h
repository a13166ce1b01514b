#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/base/geometry.h"

namespace rangezip {

/// Up to `wanted` points that are spread over the surface, however dense the cloud is there: each
/// the first in another cube of a grid, with 16 along the diagonal of the box, out of those cubes
/// that hold three or more of up to 100,000 points spread over the cloud. Most outliers are alone
/// in their cube. In the order of the points. O(points looked at).
/// @param box of the object, without far outliers; not empty
[[nodiscard]] std::vector<Vec3> places_over_surface(std::span<const Vec3> points, const Box& box,
                                                    std::size_t wanted);

}  // namespace rangezip
