#include "core/scene/curve_order.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/curve_order.h"

namespace rangezip {

bool follow_each_other(std::span<const Vec3f> positions) {
  constexpr std::size_t kPairs = 1024;
  if (positions.size() < 2) return true;
  Box box;
  for (const Vec3f& p : positions)
    box.add(Vec3(p));
  const double near = box.diagonal() / 64.0;
  std::size_t close = 0;
  for (std::size_t pair = 0; pair < kPairs; ++pair) {
    const std::size_t at = (positions.size() - 2) * pair / (kPairs - 1);
    close += glm::length(Vec3(positions[at + 1]) - Vec3(positions[at])) <= near ? 1 : 0;
  }
  return close > kPairs / 2;
}

PointCloud ordered_along_curve(const PointCloud& cloud, const Progress& progress) {
  constexpr std::size_t kBlock = 65536;  // points between two looks at the stop token
  PointCloud ordered;
  ordered.positions.reserve(cloud.positions.size());
  ordered.numbers.reserve(cloud.positions.size());
  for (const std::uint32_t i : order_along_curve(cloud.positions, progress)) {
    if (ordered.positions.size() % kBlock == 0) progress.check_stop();
    ordered.positions.push_back(cloud.positions[i]);
    ordered.numbers.push_back(cloud.numbers.empty() ? i : cloud.numbers[i]);
  }
  return ordered;
}

}  // namespace rangezip
