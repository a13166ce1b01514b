#pragma once

#include <cstddef>

#include "core/image/range_image.h"

namespace rangezip {

struct BackSideOptions {
  double min_gap = 0.0;  ///< model units; a smaller largest gap removes nothing
};

struct BackSideResult {
  RangeImage image;
  double threshold = kNoSample;  ///< samples beyond this eye depth were removed
  double gap = 0.0;              ///< the largest step between sorted depths, model units
  std::size_t removed = 0;       ///< samples
};

/// Removes samples that look through the front of a sparse cloud onto its back: those behind the
/// largest gap in the sorted depths [Kobbelt, Botsch 2000, 4.2]. Without a back side the heuristic
/// only touches samples near the outline. O(n log n) in the samples.
[[nodiscard]] BackSideResult remove_back_side(RangeImage image,
                                              const BackSideOptions& options = {});

}  // namespace rangezip
