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

/// R13 for the pixel rows of `rows` only: bands of rows share no pixel, so each may have a thread.
/// @param votes one a point, or empty
/// @throws Error if a pixel takes more than kMaxPointsPerPixel points
void add_moments(std::span<const SnappedPosition> points, std::span<const std::int8_t> votes,
                 PixelRange rows, const MomentTarget& target);

}  // namespace rangezip
