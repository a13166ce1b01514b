#include "raster_cpu/point_moments.h"

#include <cstdlib>
#include <string>

#include "core/base/error.h"

namespace rangezip {

namespace {

[[noreturn]] void throw_too_many(const MomentTarget& target, std::size_t pixel) {
  const auto width = static_cast<std::size_t>(target.extent.width);
  throw Error("accumulate: a pixel takes at most 2^19 points, more lie around pixel (" +
              std::to_string(pixel % width) + ", " + std::to_string(pixel / width) +
              "); use smaller pixels");
}

/// One point at one pixel, dx and dy from the pixel's centre.
void add_term(PixelMoments& sums, std::int32_t dx, std::int32_t dy, std::int64_t z, int vote) {
  const std::int32_t w = (kSubpixels - std::abs(dx)) * (kSubpixels - std::abs(dy));
  const std::int32_t w_dx = w * dx;
  const std::int32_t w_dy = w * dy;
  const std::int64_t w_z = w * z;
  sums.w += w;
  sums.w_dx += w_dx;
  sums.w_dy += w_dy;
  sums.w_dx_dx += std::int64_t{w_dx} * dx;
  sums.w_dx_dy += std::int64_t{w_dx} * dy;
  sums.w_dy_dy += std::int64_t{w_dy} * dy;
  sums.w_z += w_z;
  sums.w_z_dx += w_z * dx;
  sums.w_z_dy += w_z * dy;
  sums.w_vote += std::int64_t{w} * vote;
}

}  // namespace

void add_moments(std::span<const SnappedPosition> points, std::span<const std::int8_t> votes,
                 PixelRange rows, const MomentTarget& target) {
  const AccumulateWindow& window = *target.window;
  const auto lower = window.band.lower.pixels();
  const auto upper = window.band.upper.pixels();
  const auto reference = window.reference.pixels();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SnappedPosition& p = points[i];
    if (is_rejected(p) || static_cast<std::uint32_t>(p.z) > kMaxDepth) continue;
    // The centres less than a pixel away: two along each axis, or one if the point is level
    // with it.
    const PixelRange near_x = centers_between(p.x - kSubpixels + 1, p.x + kSubpixels - 1);
    const PixelRange near_y = centers_between(p.y - kSubpixels + 1, p.y + kSubpixels - 1);
    const PixelRange columns = on_screen(near_x, target.extent.width);
    const int first_row = std::max(near_y.first, rows.first);
    const int last_row = std::min(near_y.last, rows.last);
    const int vote = votes.empty() ? 0 : votes[i];
    for (int y = first_row; y <= last_row; ++y) {
      for (int x = columns.first; x <= columns.last; ++x) {
        const std::size_t pixel = target.extent.index({x, y});
        if (p.z < lower[pixel] || p.z > upper[pixel]) continue;
        if (++target.counts[pixel] > kMaxPointsPerPixel) throw_too_many(target, pixel);
        const std::int64_t z = (std::int64_t{p.z} - reference[pixel]) >> window.shift;
        add_term(target.moments[pixel], p.x - pixel_center(x), p.y - pixel_center(y), z, vote);
      }
    }
  }
}

}  // namespace rangezip
