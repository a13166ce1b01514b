#pragma once

#include <algorithm>
#include <limits>
#include <span>

#include "core/base/grid.h"

namespace rangezip {

/// Pixels first..last both ways, in the image or beyond it; empty until something is added.
struct PixelBox {
  Pixel first{std::numeric_limits<int>::max(), std::numeric_limits<int>::max()};
  Pixel last{std::numeric_limits<int>::min(), std::numeric_limits<int>::min()};

  [[nodiscard]] bool is_empty() const { return first.x > last.x || first.y > last.y; }
  void add(Pixel p) {
    first = {std::min(first.x, p.x), std::min(first.y, p.y)};
    last = {std::max(last.x, p.x), std::max(last.y, p.y)};
  }
  [[nodiscard]] PixelBox within(const PixelBox& box) const {
    return {{std::max(first.x, box.first.x), std::max(first.y, box.first.y)},
            {std::min(last.x, box.last.x), std::min(last.y, box.last.y)}};
  }
  /// With as many pixels more on every side. @pre not empty
  [[nodiscard]] PixelBox widened(int pixels) const {
    return {{first.x - pixels, first.y - pixels}, {last.x + pixels, last.y + pixels}};
  }

  /// A grid over the box has this extent, and a pixel this place in it. @pre not empty
  [[nodiscard]] Extent extent() const { return {last.x - first.x + 1, last.y - first.y + 1}; }
  [[nodiscard]] Pixel local(Pixel p) const { return {p.x - first.x, p.y - first.y}; }
};

[[nodiscard]] inline PixelBox box_around(std::span<const Pixel> pixels) {
  PixelBox box;
  for (const Pixel p : pixels)
    box.add(p);
  return box;
}

}  // namespace rangezip
