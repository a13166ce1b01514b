#include "core/plan/slab_index.h"

#include <algorithm>
#include <cmath>

namespace rangezip {

SlabIndex::SlabIndex(std::span<const Ball> balls) {
  const std::size_t margin = balls.size() / 32;
  lower_ = balls[margin].center.x;
  const double width = balls[balls.size() - 1 - margin].center.x - lower_;
  slabs_per_unit_ = width > 0.0 ? kSlabs / width : 0.0;
  if (!std::isfinite(slabs_per_unit_)) slabs_per_unit_ = 0.0;

  for (std::uint32_t i = 0; i < balls.size(); ++i) {
    const double x = balls[i].center.x;
    const double radius = balls[i].radius;
    for (std::size_t s = slab_of(x - radius); s <= slab_of(x + radius); ++s)
      balls_of_slab_[s].push_back(i);
  }
}

std::size_t SlabIndex::slab_of(double x) const {
  const double slab = (x - lower_) * slabs_per_unit_;
  return slab > 0.0 ? static_cast<std::size_t>(std::min(slab, kSlabs - 1.0)) : 0;
}

std::vector<std::vector<Vec3>> offsets_in_balls(std::span<const SlabIndex::Ball> balls,
                                                std::span<const Vec3> points) {
  std::vector<std::vector<Vec3>> inside(balls.size());
  if (balls.empty()) return inside;
  const SlabIndex slabs(balls);
  for (const Vec3& point : points) {
    for (const std::uint32_t b : slabs.balls_near(point.x)) {
      const Vec3 offset = point - balls[b].center;
      const double squared = glm::dot(offset, offset);
      if (squared == 0.0 || squared > balls[b].radius * balls[b].radius) continue;
      inside[b].push_back(offset);
    }
  }
  return inside;
}

}  // namespace rangezip
