#include "raster_cpu/point_moments.h"

#include <algorithm>
#include <cstdlib>
#include <string>

#include "core/base/error.h"

namespace rangezip {

namespace {

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

void count_points(const MomentTarget& target, std::size_t pixel, std::uint32_t points) {
  target.counts[pixel] += points;
  if (target.counts[pixel] <= kMaxPointsPerPixel) return;
  const auto width = static_cast<std::size_t>(target.extent.width);
  throw Error("accumulate: a pixel takes at most 2^19 points, more lie around pixel (" +
              std::to_string(pixel % width) + ", " + std::to_string(pixel / width) +
              "); use smaller pixels");
}

void add_moments(const SnappedPosition& point, int vote, PixelRange rows,
                 const MomentTarget& target) {
  if (point.z < 0 || point.z > static_cast<std::int32_t>(kMaxDepth)) return;
  const AccumulateWindow& window = *target.window;
  const PixelRange columns =
      on_screen({first_near(point.x), first_near(point.x) + 1}, target.extent.width);
  const int y0 = first_near(point.y);
  for (int y = std::max(y0, rows.first); y <= std::min(y0 + 1, rows.last); ++y) {
    for (int x = columns.first; x <= columns.last; ++x) {
      const std::int32_t dx = point.x - pixel_center(x);
      const std::int32_t dy = point.y - pixel_center(y);
      if (dx == -kSubpixels || dy == -kSubpixels) continue;  // a whole pixel away: no weight
      const std::size_t pixel = target.extent.index({x, y});
      if (point.z < window.band.lower.pixels()[pixel]) continue;
      if (point.z > window.band.upper.pixels()[pixel]) continue;
      count_points(target, pixel, 1);
      const std::int64_t z = std::int64_t{point.z} - window.reference.pixels()[pixel];
      add_term(target.moments[pixel], dx, dy, z >> window.shift, vote);
    }
  }
}

}  // namespace rangezip
