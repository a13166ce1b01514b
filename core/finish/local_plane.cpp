#include "core/finish/local_plane.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/base/spread.h"
#include "core/base/symmetric_eigen.h"

namespace rangezip {
namespace {

constexpr std::size_t kNoiseSamples = 1000;

}  // namespace

std::optional<LocalPlane> plane_at(const Vec3& place, const PointGrid& cloud, double radius) {
  constexpr double kFewest = 6.0;
  Vec3 sum(0.0);
  Mat3 moments(0.0);
  double count = 0.0;
  cloud.for_each_near(place, radius, [&](const Vec3& offset) {
    if (glm::dot(offset, offset) > radius * radius) return;
    sum += offset;
    moments += glm::outerProduct(offset, offset);
    count += 1.0;
  });
  if (count < kFewest) return std::nullopt;
  const Vec3 mean = sum / count;
  const SymmetricEigen eigen = eigen_of_symmetric(moments - glm::outerProduct(mean, sum));
  const Vec3 normal = eigen.vectors[0];
  return LocalPlane{place + glm::dot(mean, normal) * normal, normal, eigen.vectors[2],
                    std::sqrt(std::max(0.0, eigen.values[0]) / count)};
}

double noise_of(std::span<const Vec3> points, const PointGrid& cloud, double pixel_size) {
  std::vector<double> thickness;
  for (const std::size_t i : spread_indices(points.size(), kNoiseSamples)) {
    if (const auto plane = plane_at(points[i], cloud, kPlaneRadius * pixel_size))
      thickness.push_back(plane->thickness);
  }
  if (thickness.empty()) return 0.0;
  const auto quarter = thickness.begin() + static_cast<std::ptrdiff_t>(thickness.size() / 4);
  std::nth_element(thickness.begin(), quarter, thickness.end());
  return *quarter;
}

}  // namespace rangezip
