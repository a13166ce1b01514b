#include "core/finish/loop_disc.h"

#include <cmath>
#include <numbers>

namespace rangezip {
namespace {

constexpr double kMiddle = 0.5;         ///< of the radius
constexpr double kLeastDensity = 0.25;  ///< of that around the polygon

}  // namespace

LoopDisc disc_of_loop(std::span<const Vec3> points) {
  const std::size_t n = points.size();
  LoopDisc disc;
  double length = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 &p = points[i], &q = points[(i + 1) % n];
    const double side = glm::length(q - p);
    disc.middle += side * 0.5 * (p + q);
    length += side;
  }
  if (!(length > 0.0)) return {.middle = points[0]};
  disc.middle /= length;
  Vec3 area{0.0};
  for (std::size_t i = 0; i < n; ++i)
    area += 0.5 * area_vector(disc.middle, points[i], points[(i + 1) % n]);
  const double size = glm::length(area);
  if (size > 0.0) disc.axis = area / size;
  disc.radius = std::sqrt(size / std::numbers::pi);
  return disc;
}

Vec3 toward_axis(const LoopDisc& disc, const Vec3& place) {
  const Vec3 offset = disc.middle - place;
  return unit_or_z(offset - glm::dot(offset, disc.axis) * disc.axis);
}

std::size_t points_in_middle(const PointGrid& cloud, const LoopDisc& disc) {
  const double radius = kMiddle * disc.radius;
  std::size_t count = 0;
  cloud.for_each_near(disc.middle, std::numbers::sqrt2 * radius, [&](const Vec3& offset) {
    const double along = glm::dot(offset, disc.axis);
    const Vec3 out = offset - along * disc.axis;
    count += std::abs(along) <= radius && glm::dot(out, out) <= radius * radius ? 1 : 0;
  });
  return count;
}

bool is_filled(const PointGrid& cloud, std::span<const Vec3> polygon, const LoopDisc& disc) {
  const std::size_t inside = points_in_middle(cloud, disc);
  if (inside == 0) return false;
  std::size_t along = 0;
  for (const Vec3& p : polygon)
    along += cloud.count_within(p, kMiddle * disc.radius);
  return static_cast<double>(inside * polygon.size()) >= kLeastDensity * static_cast<double>(along);
}

}  // namespace rangezip
