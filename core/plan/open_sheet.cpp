#include "core/plan/open_sheet.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "core/base/spread.h"
#include "core/plan/directions.h"
#include "core/plan/front_sheet.h"
#include "core/plan/spacing.h"

namespace rangezip {

namespace {

/// Flags of the points seen from a direction.
std::vector<std::uint8_t> seen_from(Rasterizer& rasterizer, const DrawPoints& cloud,
                                    const Box& bounds, const Vec3& toward_viewer, double pixel_size,
                                    Framebuffer& buffer) {
  const std::array<DrawItem, 1> items{cloud};
  const FrontSheet front(rasterizer, items, bounds, toward_viewer, pixel_size, buffer);
  std::vector<std::uint8_t> is_seen(cloud.positions.size(), 0);
  front.for_each_seen(cloud, [&](std::size_t i) { is_seen[i] = 1; });
  return is_seen;
}

}  // namespace

bool is_open_sheet(Rasterizer& rasterizer, std::span<const Vec3> points, const Progress& progress) {
  constexpr std::size_t kSubset = 60'000;
  constexpr int kDirections = 40;
  constexpr double kSheetShare = 0.3;
  std::vector<Vec3> subset;
  for (const std::size_t index : spread_indices(points.size(), kSubset)) {
    subset.push_back(points[index]);
  }
  const double pixel_size = closed_sheet_pixel_size(estimate_spacing(subset));

  const Box bounds = robust_bounds(subset);
  const Vec3 origin = bounds.center();
  std::vector<Vec3f> local;
  local.reserve(subset.size());
  for (const Vec3& p : subset)
    local.emplace_back(p - origin);
  DrawPoints cloud{.positions = local};
  cloud.world_from_item[3] = Vec4(origin, 1.0);

  Framebuffer buffer;
  std::size_t either = 0, both = 0;
  for (const Vec3& direction : sphere_directions(kDirections)) {
    if (direction.z < 0.0) continue;  // their opposites are looked at
    progress.check_stop();
    const auto front = seen_from(rasterizer, cloud, bounds, direction, pixel_size, buffer);
    const auto back = seen_from(rasterizer, cloud, bounds, -direction, pixel_size, buffer);
    for (std::size_t i = 0; i < front.size(); ++i) {
      either += front[i] | back[i];
      both += front[i] & back[i];
    }
  }
  return static_cast<double>(both) > kSheetShare * static_cast<double>(either);
}

}  // namespace rangezip
