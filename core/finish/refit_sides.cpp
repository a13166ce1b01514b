#include "core/finish/refit_sides.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "core/base/solve.h"

namespace rangezip {
namespace {

constexpr int kRounds = 3;
constexpr double kRadius = 1.3;   // of that of the surroundings
constexpr double kHeight = 0.35;  // in h: points farther from all sides count for none
constexpr int kMinPoints = 6;
constexpr double kDamping = 1e-4;  // of the diagonal: points in a row do not tilt a side

/// The normal equations for how far a side is to be raised and tilted.
struct SideSums {
  Vec3 u{0.0}, v{0.0};  ///< unit, along the side
  Mat3 products{0.0};
  Vec3 right{0.0};
  int count = 0;

  explicit SideSums(const FeatureSide& side) {
    const Vec3 normal = unit_or_z(side.height.slope);
    const Vec3 other = std::abs(normal.x) < 0.6 ? Vec3(1.0, 0.0, 0.0) : Vec3(0.0, 1.0, 0.0);
    u = glm::normalize(glm::cross(normal, other));
    v = glm::cross(normal, u);
  }

  /// @param p in radii
  void add(const Vec3& p, double height) {
    ++count;
    const double weight = 1.0 - glm::dot(p, p);
    if (!(weight > 0.0)) return;
    const Vec3 row{1.0, glm::dot(u, p), glm::dot(v, p)};
    products += weight * glm::outerProduct(row, row);
    right -= weight * height * row;
  }

  void apply(SurfaceHeight& height, double radius) const {
    if (count < kMinPoints) return;
    Mat3 damped = products;
    for (int i = 0; i < 3; ++i)
      damped[i][i] *= 1.0 + kDamping;
    const std::optional<Vec3> change = solve(damped, right, 0.0);
    if (!change) return;
    height.constant += change->x;
    height.slope += (change->y * u + change->z * v) / radius;
  }
};

/// The side that a point lies on, and how high it lies over that.
struct OnSide {
  std::size_t side = 0;  ///< as many as there are if it lies on none
  double height = 0.0;
};

OnSide side_of(const Vec3& p, const std::vector<FeatureSide>& sides, double farthest) {
  OnSide nearest{sides.size()};
  double least = farthest;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const double height = sides[i].height.at(p);
    if (std::abs(height) >= least) continue;
    least = std::abs(height);
    nearest = {i, height};
  }
  return nearest;
}

}  // namespace

std::vector<FeatureSide> refit_sides(const Surroundings& around) {
  const double radius = kRadius * around.radius;
  std::vector<Vec3> points;
  around.cloud.for_each_near(around.origin, radius, [&](const Vec3& p) { points.push_back(p); });
  std::vector<FeatureSide> sides = around.sides;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<SideSums> sums(sides.begin(), sides.end());
    for (const Vec3& p : points) {
      const auto [i, height] = side_of(p, sides, kHeight * around.pixel_size);
      if (i < sides.size()) sums[i].add(p / radius, height);
    }
    for (std::size_t i = 0; i < sides.size(); ++i)
      sums[i].apply(sides[i].height, radius);
  }
  return sides;
}

}  // namespace rangezip
