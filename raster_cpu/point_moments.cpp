#include "raster_cpu/point_moments.h"

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

bool is_summed(const SnappedPosition& p, Extent extent) {
  const int x = first_near(p.x);
  const int y = first_near(p.y);
  return x >= -1 && x < extent.width && y >= -1 && y < extent.height &&
         static_cast<std::uint32_t>(p.z) <= kMaxDepth;
}

/// A point touches the rows first_near(y) and first_near(y) + 1; the upper one chooses the bin, so
/// bin k touches the rows from k * kRows - 1 to (k + 1) * kRows - 1.
std::size_t bin_of(const SnappedPosition& p) {
  return static_cast<std::size_t>((first_near(p.y) + 1) / RowBins::kRows);
}

}  // namespace

void throw_too_many_points(const MomentTarget& target, std::size_t pixel) {
  const auto width = static_cast<std::size_t>(target.extent.width);
  throw Error("accumulate: a pixel takes at most 2^19 points, more lie around pixel (" +
              std::to_string(pixel % width) + ", " + std::to_string(pixel / width) +
              "); use smaller pixels");
}

void RowBins::fill(std::span<const SnappedPosition> points, std::span<const std::int8_t> votes,
                   Extent extent) {
  // A counting sort: sizes, starts, then every point to the next place of its bin.
  const auto bins = static_cast<std::size_t>(extent.height / kRows) + 1;
  starts_.assign(bins + 1, 0);
  for (const SnappedPosition& p : points) {
    if (is_summed(p, extent)) ++starts_[bin_of(p) + 1];
  }
  for (std::size_t k = 0; k < bins; ++k)
    starts_[k + 1] += starts_[k];
  points_.resize(starts_[bins]);
  std::vector<std::size_t> next(starts_.begin(), starts_.end() - 1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!is_summed(points[i], extent)) continue;
    points_[next[bin_of(points[i])]++] = {points[i], votes.empty() ? 0 : votes[i]};
  }
}

std::span<const RowBins::Point> RowBins::touching(int first, int last) const {
  const auto first_bin = static_cast<std::size_t>(first / kRows);
  const auto last_bin = static_cast<std::size_t>(last / kRows);
  return std::span(points_).subspan(starts_[first_bin], starts_[last_bin + 1] - starts_[first_bin]);
}

void add_moments(std::span<const RowBins::Point> points, PixelRange rows,
                 const MomentTarget& target) {
  for_each_term(points, rows, target, add_term);
}

}  // namespace rangezip
