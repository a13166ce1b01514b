#include "core/image/back_side.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace rangezip {

namespace {

struct Gap {
  double size = 0.0;
  double before = kNoSample;  ///< the last depth in front of it
};

/// The largest step between sorted depths; of equal ones the nearest.
Gap largest_gap(const std::vector<double>& sorted) {
  Gap largest;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    const double size = sorted[i] - sorted[i - 1];
    if (size > largest.size) largest = {size, sorted[i - 1]};
  }
  return largest;
}

}  // namespace

BackSideResult remove_back_side(RangeImage image, const BackSideOptions& options) {
  std::vector<double> depths;
  depths.reserve(image.extent().count());
  for (const double depth : image.depth().pixels()) {
    if (depth != kNoSample) depths.push_back(depth);
  }
  std::sort(depths.begin(), depths.end());
  const Gap gap = largest_gap(depths);

  BackSideResult result{.image = std::move(image), .gap = gap.size};
  if (gap.size <= 0.0 || gap.size < options.min_gap) return result;
  result.threshold = gap.before;
  for (int y = 0; y < result.image.extent().height; ++y) {
    for (double& depth : result.image.row(y)) {
      if (depth == kNoSample || depth <= gap.before) continue;
      depth = kNoSample;
      ++result.removed;
    }
  }
  return result;
}

}  // namespace rangezip
