#pragma once

#include "core/base/grid.h"
#include "core/image/range_image.h"

namespace rangezip {

struct SteepCellsOptions {
  double min_cosine = 0.2588;  ///< cosine of the largest angle between normal and line of sight
                               ///< (0.2588: 75 degrees), in (0, 1]
};

/// Marks samples that every cell around sees almost tangentially: 1 where no grid triangle at the
/// pixel has a normal within the angle [Kobbelt, Botsch 2000, 4.2]. Samples without a neighbour
/// are not marked. O(pixels). @throws InvalidArgument if min_cosine is out of range.
[[nodiscard]] Mask mark_steep_cells(const RangeImage& image, const SteepCellsOptions& options = {});

}  // namespace rangezip
