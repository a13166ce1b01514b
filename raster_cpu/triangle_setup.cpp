#include "raster_cpu/triangle_setup.h"

#include <algorithm>

namespace rangezip {

bool set_up(const SnappedTriangle& corners, Facing facing, Extent extent, TriangleSetup& t) {
  const auto& [a, b, c] = corners;
  const auto [x_min, x_max] = std::minmax({a.x, b.x, c.x});
  const auto [y_min, y_max] = std::minmax({a.y, b.y, c.y});
  t.columns = on_screen(centers_between(x_min, x_max), extent.width);
  t.rows = on_screen(centers_between(y_min, y_max), extent.height);
  if (t.columns.is_empty() || t.rows.is_empty()) return false;
  const auto [z_min, z_max] = std::minmax({a.z, b.z, c.z});
  if (z_max < 0 || z_min > static_cast<std::int32_t>(kMaxDepth)) return false;
  const std::int64_t area = EdgeFunction<std::int64_t>(a, b).at(c.x, c.y);
  if (area == 0 || (facing == Facing::front && area < 0) || (facing == Facing::back && area > 0)) {
    return false;
  }
  t.a = a;
  t.b = area > 0 ? b : c;
  t.c = area > 0 ? c : b;
  t.area = area > 0 ? area : -area;
  t.z_min = z_min;
  t.z_max = z_max;
  t.width = std::int64_t{x_max} - x_min;
  t.height = std::int64_t{y_max} - y_min;
  return true;
}

ExactDepth divide_down(std::int64_t numerator, std::int64_t denominator) {
  const ExactDepth d{numerator / denominator, numerator % denominator};
  return d.remainder < 0 ? ExactDepth{d.value - 1, d.remainder + denominator} : d;
}

ExactDepth divide_depth(const std::array<std::int64_t, 3>& e, const std::array<std::int64_t, 3>& z,
                        std::int64_t area) {
  // Long division with two digits in base 2^13: area <= 2^46 and digits below 2^14 keep every sum
  // below 2^63.
  constexpr int kDigitBits = 13;
  constexpr std::int64_t kDigitMask = (1 << kDigitBits) - 1;
  std::int64_t high = 0;
  std::int64_t low = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    high += e[i] * (z[i] >> kDigitBits);
    low += e[i] * (z[i] & kDigitMask);
  }
  const ExactDepth upper = divide_down(high, area);
  const ExactDepth lower = divide_down(low + upper.remainder * (1 << kDigitBits), area);
  return {upper.value * (1 << kDigitBits) + lower.value, lower.remainder};
}

}  // namespace rangezip
