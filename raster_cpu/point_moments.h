#pragma once

#include <cstdint>
#include <span>

#include "core/base/grid.h"
#include "core/raster/framebuffer.h"
#include "core/raster/row_transform.h"
#include "raster_cpu/fixed_point.h"

namespace rangezip {

/// Most points that one pixel may sum: more could overflow its 64-bit sums (R13).
inline constexpr std::uint32_t kMaxPointsPerPixel = 1U << 19U;

/// Sums of R13 and how many points each pixel has taken.
struct MomentTarget {
  Extent extent;
  const AccumulateWindow* window = nullptr;
  std::span<PixelMoments> moments;
  std::span<std::uint32_t> counts;
};

/// The lower and left one of the pixels whose centres lie less than a pixel away. -1 is the one
/// before the first.
[[nodiscard]] constexpr int first_near(std::int32_t coordinate) noexcept {
  return (coordinate - kHalfPixel) >> kSubpixelBits;
}

/// Counts points for a pixel. @throws Error that names the pixel if it has more than
/// kMaxPointsPerPixel
void count_points(const MomentTarget& target, std::size_t pixel, std::uint32_t points);

/// R13 for one point, in the pixel rows `rows` only: rows of different threads share no pixel.
/// @throws Error if a pixel takes more than kMaxPointsPerPixel points
void add_moments(const SnappedPosition& point, int vote, PixelRange rows,
                 const MomentTarget& target);

}  // namespace rangezip
