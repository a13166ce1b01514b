#pragma once

#include "core/base/grid.h"
#include "core/image/range_image.h"

namespace rangezip {

struct FillHolesOptions {
  int min_neighbours = 5;  ///< of eight, that must have a sample for a pixel to be filled
  int rounds = 2;          ///< a round fills what the one before made fillable
  double max_step = 2.1;   ///< pixel sides; of the sorted neighbours only the nearest run without a
                           ///< larger step is averaged (at least four, or min_neighbours if that
                           ///< is less), so a hole at a silhouette is filled on the front sheet
};

struct FillHolesResult {
  RangeImage image;
  Mask filled;  ///< 1 where a sample was made
};

/// Gives pixels without a sample, inside sampling gaps, the mean of their neighbours' depths.
/// Never changes a sample [Kobbelt, Botsch 2000, 4.2]. O(pixels * rounds).
/// @throws InvalidArgument if min_neighbours is not in 1..8 or rounds < 0.
[[nodiscard]] FillHolesResult fill_holes(const RangeImage& image,
                                         const FillHolesOptions& options = {});

}  // namespace rangezip
