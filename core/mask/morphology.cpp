#include "core/mask/morphology.h"

#include <algorithm>
#include <string>

#include "core/base/error.h"
#include "core/base/parallel.h"

namespace rangezip {

namespace {

void check_extents(const char* function, const Mask& mask, const Mask& limit) {
  if (mask.extent() != limit.extent()) {
    throw InvalidArgument(std::string(function) + ": the masks must have the same extent");
  }
}

/// Whether `test` holds for the pixel or one of its neighbours inside the image.
template <class F>
bool any_around(Extent extent, Pixel p, const F& test) {
  for (int y = std::max(0, p.y - 1); y <= std::min(extent.height - 1, p.y + 1); ++y) {
    for (int x = std::max(0, p.x - 1); x <= std::min(extent.width - 1, p.x + 1); ++x) {
      if (test(Pixel{x, y})) return true;
    }
  }
  return false;
}

/// A mask from a decision for each pixel.
template <class F>
Mask mask_where(Extent extent, const F& test) {
  Mask out(extent, 0);
  for_each_row(extent.height, [&](int y) {
    for (Pixel p{0, y}; p.x < extent.width; ++p.x)
      out[p] = test(p) ? 1 : 0;
  });
  return out;
}

}  // namespace

Mask erode(const Mask& mask, const Mask& limit) {
  check_extents("erode", mask, limit);
  const auto is_hole = [&](Pixel p) { return limit[p] != 0 && mask[p] == 0; };
  return mask_where(mask.extent(), [&](Pixel p) {
    return mask[p] != 0 && !any_around(mask.extent(), p, is_hole);
  });
}

Mask dilate(const Mask& mask, const Mask& limit) {
  check_extents("dilate", mask, limit);
  const auto is_active = [&](Pixel p) { return mask[p] != 0; };
  return mask_where(mask.extent(), [&](Pixel p) {
    return limit[p] != 0 && any_around(mask.extent(), p, is_active);
  });
}

Mask clean_mask(Mask mask, const Mask& region, const CleanMaskOptions& options) {
  check_extents("clean_mask", mask, region);
  if (options.erosions < 0 || options.dilations < 0) {
    throw InvalidArgument("clean_mask: erosions and dilations must not be negative, got " +
                          std::to_string(options.erosions) + " and " +
                          std::to_string(options.dilations));
  }
  for (std::size_t i = 0; i < mask.pixels().size(); ++i) {
    if (region.pixels()[i] == 0) mask.pixels()[i] = 0;
  }
  for (int i = 0; i < options.erosions; ++i)
    mask = erode(mask, region);
  for (int i = 0; i < options.dilations; ++i)
    mask = dilate(mask, region);
  return mask;
}

}  // namespace rangezip
