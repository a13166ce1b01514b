#pragma once

#include <span>
#include <vector>

#include "core/base/geometry.h"

namespace rangezip {

/// Whether most points lie near the one before, as in files written along scan lines: of 1024 pairs
/// of neighbours in the order, more than half are closer than 1/64 of the bounding box's diagonal.
/// @pre all positions are finite. O(n).
[[nodiscard]] bool follow_each_other(std::span<const Vec3f> positions);

/// The points in order along a Z-shaped curve through a grid of 1024^3 cells over their bounding
/// box, those of one cell in the order given. Drawn in such an order, points fall close to each
/// other in any view, so that the memory they are drawn into is in the cache: a run over 1.4
/// million points in random order takes a fifth less processor time.
/// @pre all positions are finite, at most 2^32 - 1 of them. O(n), by a radix sort; 16 bytes a point
/// beside the result.
[[nodiscard]] std::vector<Vec3f> ordered_along_curve(std::span<const Vec3f> positions);

}  // namespace rangezip
