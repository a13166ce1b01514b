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

}  // namespace rangezip
