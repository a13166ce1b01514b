#pragma once

#include <span>

#include "core/base/geometry.h"
#include "core/base/sphere.h"
#include "core/image/range_image.h"

namespace rangezip {

/// Every pixel of the extent active.
[[nodiscard]] Mask full_mask(Extent extent);

/// Pixels with a sample.
[[nodiscard]] Mask sample_mask(const RangeImage& image);

/// Pixels whose sample lies in one of the places. O(pixels), in parallel.
[[nodiscard]] Mask mask_of_places(const RangeImage& image, std::span<const Sphere> places);

/// The region of interest: pixels whose centre is inside the polygon (even-odd rule).
/// @param lasso Corners in window coordinates; the last is joined to the first.
/// @throws InvalidArgument if there are fewer than three corners, or one is not finite.
[[nodiscard]] Mask mask_from_lasso(Extent extent, std::span<const Vec2> lasso);

}  // namespace rangezip
