#include "core/plan/open_sheet.h"

#include <algorithm>
#include <memory>
#include <vector>

#include "core/plan/spacing.h"
#include "core/plan/spread.h"
#include "core/plan/visibility_vote.h"
#include "core/scene/scene.h"

namespace rangezip {

bool is_open_sheet(Rasterizer& rasterizer, std::span<const Vec3> points, const Progress& progress) {
  constexpr std::size_t kSubset = 60'000;
  constexpr int kDecisive = 76;  // 0.6 of a full vote of 127
  std::vector<Vec3> subset;
  for (const std::size_t index : spread_indices(points.size(), kSubset)) {
    subset.push_back(points[index]);
  }
  const double pixel_size = closed_sheet_pixel_size(estimate_spacing(subset));

  const Vec3 origin = robust_bounds(subset).center();
  PointCloud cloud;
  for (const Vec3& p : subset)
    cloud.positions.emplace_back(p - origin);
  Mat4 world_from_item{1.0};
  world_from_item[3] = Vec4(origin, 1.0);
  Scene scene;
  scene.add(std::make_shared<const PointCloud>(std::move(cloud)), world_from_item);

  std::size_t decisive = 0;
  for (const auto& vote : visibility_votes(rasterizer, scene, pixel_size, 40, progress)) {
    const int squared = vote[0] * vote[0] + vote[1] * vote[1] + vote[2] * vote[2];
    decisive += squared >= kDecisive * kDecisive ? 1U : 0U;
  }
  return 2 * decisive < subset.size();
}

}  // namespace rangezip
