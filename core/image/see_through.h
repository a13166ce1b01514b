#pragma once

#include <cstddef>

#include "core/image/range_image.h"

namespace rangezip {

struct SeeThroughOptions {
  double max_slope = 3.0;  ///< a neighbour d pixels away is compatible within max_slope * d pixel
                           ///< sides of depth
  bool remove_outliers = true;  ///< also samples that fewer than two neighbours are compatible with
  int rounds = 2;               ///< at most; stops early when nothing is removed
};

struct SeeThroughResult {
  RangeImage image;
  std::size_t removed = 0;  ///< samples
};

/// Removes samples that were seen through gaps of a nearer sheet, and lone outliers: in the 5 x 5
/// window of a pixel, most neighbours nearer by more than the limit while fewer than three are
/// compatible; or nearer ones in six of eight sectors; or (outliers) fewer than two compatible
/// ones among at least four samples. A local complement to remove_back_side(). O(pixels).
/// @throws InvalidArgument if max_slope <= 0 or rounds < 0.
[[nodiscard]] SeeThroughResult remove_see_through(RangeImage image,
                                                  const SeeThroughOptions& options = {});

}  // namespace rangezip
