#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "core/base/geometry.h"

namespace rangezip {

/// Pairs (lower index first, sorted, each once) of triangles that may have a point in common and of
/// which `is_pair` says that they count. Made for triangles that a grid does not tell apart: long
/// ones that lie across the axes, many in the place of few.
///
/// Of the three axes and three more, which follow the sides of the triangles, the one along which
/// the fewest triangles overlap is swept; where still many do, the box is cut into up to eight,
/// each with the parts of the triangles inside it, as long as that saves work. The first finds
/// slivers that lie side by side (a slim cylinder), the second such as lie in all directions. Cost:
/// O((n + m) log n) for m pairs that overlap in all six directions, if one of these tells most
/// apart; else up to O(n^1.5 log n) for long triangles that fill a box, and O(n^2) at worst.
/// @param asking only pairs with at least one of the first `asking` triangles are looked for
/// @param is_pair asked of every pair that has a point in common and of some that have none; a pair
///     may be asked for more than once, and several at the same time
[[nodiscard]] std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs_in_crowd(
    std::span<const std::array<Vec3, 3>> triangles, std::size_t asking,
    const std::function<bool(std::uint32_t, std::uint32_t)>& is_pair);

}  // namespace rangezip
