#pragma once

#include "core/mask/mask.h"

namespace rangezip {

/// Active only if all eight neighbours that lie in `limit` are; pixels outside `limit` or the
/// image do not count, so the silhouette of the object itself is not worn away.
[[nodiscard]] Mask erode(const Mask& mask, const Mask& limit);

/// Active if the pixel or any of its eight neighbours is, within `limit`.
[[nodiscard]] Mask dilate(const Mask& mask, const Mask& limit);

struct CleanMaskOptions {
  int erosions = 1;
  int dilations = 2;  ///< more than erosions: the overlap that the stitch needs

  friend bool operator==(const CleanMaskOptions&, const CleanMaskOptions&) = default;
};

/// Removes specks, closes small holes and smooths the outline; never leaves `region`
/// [Kobbelt, Botsch 2000, 4.3, Fig. 5].
/// @throws InvalidArgument for a negative count or other extents.
[[nodiscard]] Mask clean_mask(Mask mask, const Mask& region, const CleanMaskOptions& options = {});

}  // namespace rangezip
