#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/geometry.h"
#include "core/base/progress.h"

namespace rangezip {

/// Indices of places in order along a Z-shaped curve through a grid of 1024^3 cells over their
/// bounding box [Morton 1966], those of one cell in the order given: what is near each other in
/// space comes near each other in memory.
/// @pre all are finite, at most 2^32 - 1 of them. O(n), by a radix sort; 16 bytes a place beside
///     the result.
/// @throws Cancelled if `progress` says so.
[[nodiscard]] std::vector<std::uint32_t> order_along_curve(std::span<const Vec3f> places,
                                                           const Progress& progress = {});
[[nodiscard]] std::vector<std::uint32_t> order_along_curve(std::span<const Vec3> places);

}  // namespace rangezip
