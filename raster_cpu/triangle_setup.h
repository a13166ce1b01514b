#pragma once

#include <array>
#include <cstdint>

#include "core/raster/draw_item.h"
#include "core/raster/framebuffer.h"
#include "core/raster/split_triangle.h"
#include "raster_cpu/edge_function.h"
#include "raster_cpu/fixed_point.h"

namespace rangezip {

/// A triangle that may cover pixels: counter-clockwise, with the pixels of its box.
struct TriangleSetup {
  SnappedPosition a, b, c;
  std::int64_t area = 0;  ///< doubled, in subpixels^2, greater than 0
  std::int32_t z_min = 0;
  std::int32_t z_max = 0;
  PixelRange columns;
  PixelRange rows;
  std::int64_t width = 0;  ///< of the box, in subpixels, on screen or not
  std::int64_t height = 0;

  /// Corners and pixels lie within 32 pixels: 32-bit edges.
  [[nodiscard]] bool is_small() const {
    constexpr std::int64_t kSmall = std::int64_t{32} * kSubpixels;
    return width < kSmall && height < kSmall;
  }

  /// No fragment is dropped for its depth (R7).
  [[nodiscard]] bool is_in_depth_range() const {
    return z_min >= 0 && z_max <= static_cast<std::int32_t>(kMaxDepth);
  }

  /// R7 can be computed in double by DepthPlane. @pre is_in_depth_range()
  [[nodiscard]] bool fits_double() const {
    return static_cast<double>(width) * static_cast<double>(height) * (z_max - z_min) <
           0x1p52 / 6.0;
  }
};

/// R6: orients the triangle and finds its pixels. @return false if it draws nothing.
[[nodiscard]] bool set_up(const SnappedTriangle& corners, Facing facing, Extent extent,
                          TriangleSetup& setup);

/// The edges opposite to a, b and c.
template <class Int>
[[nodiscard]] std::array<EdgeFunction<Int>, 3> edges_of(const TriangleSetup& t) {
  using Edge = EdgeFunction<Int>;
  return {Edge(t.b, t.c), Edge(t.c, t.a), Edge(t.a, t.b)};
}

/// A depth as R7 has it, exactly: `value` and `remainder` / area with 0 <= remainder < area.
struct ExactDepth {
  std::int64_t value = 0;
  std::int64_t remainder = 0;
};

/// numerator / denominator, rounded down. @pre denominator > 0
[[nodiscard]] ExactDepth divide_down(std::int64_t numerator, std::int64_t denominator);

/// floor(sum of e * z / area) for edge values e that add up to `area`, of at most 2^47 each, and
/// 0 <= z <= 2^26.
[[nodiscard]] ExactDepth divide_depth(const std::array<std::int64_t, 3>& e,
                                      const std::array<std::int64_t, 3>& z, std::int64_t area);

/// R7 in double. The depth at a point with the values e_a and e_b of the edges opposite to a and b
/// is z_c + floor(n / area) with n = e_a (z_a - z_c) + e_b (z_b - z_c). That floor is the integer
/// nearest to (n + (1 - area) / 2) / area, which is at least 1 / (2 area) away from a half.
///
/// For a triangle that fits_double(), with d its range of depths and w x h its box: edges are at
/// most 2 w h anywhere in the box, so |n| <= 4 w h d, and with half the area it stays below 2^52:
/// halves are exact. Where the triangle covers, n is between -area d and area d, and area <= w h;
/// so the product with the rounded 1 / area errs by at most (d + 1/2) 2^-52 < 1 / (4 area).
struct DepthPlane {
  double z_a_c = 0.0;
  double z_b_c = 0.0;
  double addend = 0.0;  ///< (1 - area) / 2
  double per_area = 0.0;
  /// Added to the product, it leaves the depth in the low bits of the double: in its range, doubles
  /// are a unit apart.
  double depth_in_low_bits = 0.0;

  explicit DepthPlane(const TriangleSetup& t)
      : z_a_c(static_cast<double>(t.a.z) - t.c.z),
        z_b_c(static_cast<double>(t.b.z) - t.c.z),
        addend(0.5 * static_cast<double>(1 - t.area)),
        per_area(1.0 / static_cast<double>(t.area)),
        depth_in_low_bits(0x1.8p52 + t.c.z) {}
};

}  // namespace rangezip
