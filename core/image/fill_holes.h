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
  int reach = 0;  ///< pixels: before all rounds, a pixel on a straight line between two samples no
                  ///< farther apart gets a sample on that line; 0: not done
};

struct FillHolesResult {
  RangeImage image;
  Mask filled;  ///< 1 where a sample was made
};

/// Gives pixels without a sample, inside sampling gaps, the mean of their neighbours' depths.
/// Never changes a sample [Kobbelt, Botsch 2000, 4.2]. With a `reach`, samples on lines that are
/// far apart, as of a cloud of contours, are joined first: along a row, a column or a diagonal of
/// pixels, whichever is shortest. O(pixels * (rounds + reach)).
/// @throws InvalidArgument if min_neighbours is not in 1..8, rounds < 0 or reach < 0.
[[nodiscard]] FillHolesResult fill_holes(const RangeImage& image,
                                         const FillHolesOptions& options = {});

}  // namespace rangezip
