#pragma once

#include "core/image/range_image.h"

namespace rangezip {

struct MedianFilterOptions {
  static constexpr int kMostRadius = 50;
  int radius = 1;         ///< pixels, 1 to kMostRadius; the window is (2 radius + 1)^2
  double max_step = 4.5;  ///< pixel sides; neighbours farther away in depth belong to another
                          ///< sheet and do not take part
};

/// Replaces every sample by the median of the samples around it. A neighbour takes part together
/// with the one opposite to it, or not at all, so a tilted plane stays that plane up to its border.
/// Removes jitter and keeps steps; never makes a sample where there was none, nor removes one, so
/// the outline of the object stays
/// [Kobbelt, Botsch 2000, 4.2, Fig. 4]. O(pixels * radius^2).
/// @throws InvalidArgument if options.radius is not in 1..kMostRadius or max_step <= 0.
[[nodiscard]] RangeImage median_filter(const RangeImage& image,
                                       const MedianFilterOptions& options = {});

}  // namespace rangezip
