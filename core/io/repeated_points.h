#pragma once

#include <cstddef>
#include <vector>

#include "core/base/geometry.h"

namespace rangezip {

/// Drops all but the first of the points that lie in one and the same place, where these are one
/// in a hundred of all or more, as far as 4,096 points spread over the list tell: scanners give
/// what they have not seen as one place, mostly (0, 0, 0). Points that coincide by chance, or since
/// a scan was given twice, stay. O(points).
/// @return how many were dropped; the others keep their order
std::size_t drop_repeated_points(std::vector<Vec3f>& points);

}  // namespace rangezip
