#pragma once

#include <cstdint>

#include "core/raster/row_transform.h"

namespace rangezip {

/// One edge of a triangle as the linear function E of R6: 0 on the line from `from` to `to`,
/// positive on its left. Twice the area of (from, to, p), in subpixels^2.
/// Int is std::int64_t, or std::int32_t where all corners and points lie within 32 pixels.
template <class Int>
struct EdgeFunction {
  Int dx;        ///< per subpixel up
  Int minus_dy;  ///< per subpixel to the right
  Int from_x;
  Int from_y;

  EdgeFunction(const SnappedPosition& from, const SnappedPosition& to)
      : dx(Int{to.x} - from.x), minus_dy(Int{from.y} - to.y), from_x(from.x), from_y(from.y) {}

  [[nodiscard]] Int at(std::int32_t x, std::int32_t y) const {
    return dx * (y - from_y) + minus_dy * (x - from_x);
  }

  /// R6's tie rule: the least value that is inside. 0 for a left or a lower edge, which owns the
  /// centres upon it, 1 for the others.
  [[nodiscard]] Int least_inside() const {
    return minus_dy > 0 || (minus_dy == 0 && dx > 0) ? 0 : 1;
  }
};

}  // namespace rangezip
