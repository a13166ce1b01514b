#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/grid.h"
#include "core/raster/framebuffer.h"
#include "core/raster/row_transform.h"
#include "raster_cpu/fixed_point.h"

namespace rangezip {

/// Most points that one pixel may sum: more could overflow its 64-bit sums (R13).
inline constexpr std::uint32_t kMaxPointsPerPixel = 1U << 19U;

/// The visible points of a chunk, sorted by pixel rows. Sums take 80 bytes a pixel, so points in
/// the order of a file would miss the cache four times each; rows of one bin stay in it (random
/// order, 1024 x 1024 pixels: 4.5 million points a second without bins, 12 with them).
class RowBins {
 public:
  /// Rows of pixels per bin.
  static constexpr int kRows = 4;

  /// @param votes one a point, or empty
  void fill(std::span<const SnappedPosition> points, std::span<const std::int8_t> votes,
            Extent extent);

  struct Point {
    SnappedPosition at;
    std::int32_t vote = 0;
  };
  /// All points that touch the pixel rows [first, last), and some that do not.
  /// @pre first and last are multiples of kRows, or last is the height
  [[nodiscard]] std::span<const Point> touching(int first, int last) const;

 private:
  std::vector<Point> points_;
  std::vector<std::size_t> starts_;  ///< bin k is [starts_[k], starts_[k + 1])
};

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

/// @throws Error that names the pixel
[[noreturn]] void throw_too_many_points(const MomentTarget& target, std::size_t pixel);

/// Calls add(sums, dx, dy, z, vote) for each point and each pixel in `rows` that takes it: R13 but
/// for the sums themselves.
/// @throws Error if a pixel takes more than kMaxPointsPerPixel points
template <class Add>
void for_each_term(std::span<const RowBins::Point> points, PixelRange rows,
                   const MomentTarget& target, const Add& add) {
  const AccumulateWindow& window = *target.window;
  const auto lower = window.band.lower.pixels();
  const auto upper = window.band.upper.pixels();
  const auto reference = window.reference.pixels();
  for (const auto& [p, vote] : points) {
    const int x0 = first_near(p.x);
    const int y0 = first_near(p.y);
    for (int y = std::max(y0, rows.first); y <= std::min(y0 + 1, rows.last); ++y) {
      const std::int32_t dy = p.y - pixel_center(y);
      for (int x = std::max(x0, 0); x <= std::min(x0 + 1, target.extent.width - 1); ++x) {
        const std::int32_t dx = p.x - pixel_center(x);
        const std::size_t pixel = target.extent.index({x, y});
        if (p.z < lower[pixel] || p.z > upper[pixel]) continue;
        if (dx == -kSubpixels || dy == -kSubpixels) continue;  // a whole pixel away: no weight
        if (++target.counts[pixel] > kMaxPointsPerPixel) throw_too_many_points(target, pixel);
        const std::int64_t z = (std::int64_t{p.z} - reference[pixel]) >> window.shift;
        add(target.moments[pixel], dx, dy, z, vote);
      }
    }
  }
}

/// R13 for the pixel rows in `rows` only: bands of rows share no pixel, so each may have a thread.
/// @throws Error if a pixel takes more than kMaxPointsPerPixel points
void add_moments(std::span<const RowBins::Point> points, PixelRange rows,
                 const MomentTarget& target);

}  // namespace rangezip
