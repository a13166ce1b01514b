#pragma once

#include <cstdint>

#include "core/base/grid.h"
#include "core/raster/row_transform.h"
#include "raster_cpu/fixed_point.h"
#include "raster_cpu/point_bins.h"
#include "raster_cpu/point_moments.h"

namespace rangezip {

/// A cell is the square between four pixel centres: the pixels that its points count for (R13).
/// Cell (x, y) has pixel (x, y) at its upper right corner, so there are (width + 1) x (height + 1).
/// A bin holds kCellRows rows of cells. Sums take 80 bytes a pixel: points in the order of a file
/// would miss the cache four times each, while those of a bin stay in it.
inline constexpr int kCellRowBits = 2;
inline constexpr int kCellRows = 1 << kCellRowBits;

[[nodiscard]] constexpr std::size_t cell_bins(Extent extent) noexcept {
  return static_cast<std::size_t>(extent.height >> kCellRowBits) + 1;
}

/// A point in its bin, from the highest bit down: 14 bits for the cell's x, 2 for its row in the
/// bin, 8 + 8 for the offset from the lower left centre in 1/256 px, 24 for the depth, 8 for the
/// vote.
inline constexpr int kCellBits = 16;
[[nodiscard]] constexpr std::uint32_t cell_of(BinEntry e) noexcept {
  return static_cast<std::uint32_t>(e >> (64 - kCellBits));
}
[[nodiscard]] constexpr std::int32_t offset_x(BinEntry e) noexcept {
  return static_cast<std::int32_t>(e >> 40U & 0xffU);
}
[[nodiscard]] constexpr std::int32_t offset_y(BinEntry e) noexcept {
  return static_cast<std::int32_t>(e >> 32U & 0xffU);
}
[[nodiscard]] constexpr std::int32_t depth_in_cell(BinEntry e) noexcept {
  return static_cast<std::int32_t>(e >> 8U & 0xff'ffffU);
}
[[nodiscard]] constexpr std::int32_t vote_of(BinEntry e) noexcept {
  return static_cast<std::int8_t>(e & 0xffU);
}

/// The cell of an entry of bin `bin`.
[[nodiscard]] constexpr Pixel cell_position(BinEntry e, std::size_t bin) noexcept {
  const std::uint32_t cell = cell_of(e);
  return {static_cast<int>(cell >> kCellRowBits),
          static_cast<int>(bin) * kCellRows + static_cast<int>(cell % kCellRows)};
}

/// The position that an entry of cell `cell` was made from.
[[nodiscard]] constexpr SnappedPosition position_in_cell(BinEntry e, Pixel cell) noexcept {
  return {pixel_center(cell.x - 1) + offset_x(e), pixel_center(cell.y - 1) + offset_y(e),
          depth_in_cell(e)};
}

}  // namespace rangezip
