#include <algorithm>
#include <array>
#include <cmath>
#include <variant>

#include "core/base/spread.h"
#include "core/plan/spacing.h"

namespace rangezip {

namespace {

/// Per axis, the interval that holds the middle half of the points.
Box middle_half(std::span<const Vec3> points) {
  constexpr std::size_t kSubset = 50'000;  // its quartiles are good to 1 % of the distribution
  const std::vector<std::size_t> subset = spread_indices(points.size(), kSubset);
  Box middle;
  std::vector<double> values(subset.size());
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < subset.size(); ++i)
      values[i] = points[subset[i]][axis];
    const auto quarter = static_cast<std::ptrdiff_t>((values.size() - 1) / 4);
    const auto three_quarters = static_cast<std::ptrdiff_t>((values.size() - 1) * 3 / 4);
    std::nth_element(values.begin(), values.begin() + quarter, values.end());
    middle.lower[axis] = values[static_cast<std::size_t>(quarter)];
    std::nth_element(values.begin() + quarter, values.begin() + three_quarters, values.end());
    middle.upper[axis] = values[static_cast<std::size_t>(three_quarters)];
  }
  return middle;
}

/// How far a fence may move outward, and what is found on the way there.
class FenceSteps {
 public:
  void count(double steps_beyond) {
    if (steps_beyond < kMaxSteps) ++points_[static_cast<std::size_t>(steps_beyond)];
  }
  /// Steps from the fence on that each hold at least `dense` points, and one for the tip of what
  /// is there.
  [[nodiscard]] int dense_steps(std::size_t dense) const {
    int steps = 0;
    while (steps < kMaxSteps && points_[static_cast<std::size_t>(steps)] >= dense)
      ++steps;
    return steps == 0 ? 0 : steps + 1;
  }

 private:
  static constexpr int kMaxSteps = 64;
  std::array<std::size_t, kMaxSteps> points_{};
};

/// The middle half, widened as the header says.
Box fence_around(std::span<const Vec3> points, const Box& middle) {
  constexpr double kReach = 4.0;
  constexpr std::size_t kDenseShare = 1000;  // one in so many points makes a step dense
  const Vec3 sides = middle.upper - middle.lower;
  const double side = std::max({sides.x, sides.y, sides.z});
  Box fence{middle.lower - kReach * side, middle.upper + kReach * side};

  std::array<FenceSteps, 3> below;
  std::array<FenceSteps, 3> above;
  for (const Vec3& p : points) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      if (p[axis] < fence.lower[axis]) below[a].count((fence.lower[axis] - p[axis]) / side);
      if (p[axis] > fence.upper[axis]) above[a].count((p[axis] - fence.upper[axis]) / side);
    }
  }
  const std::size_t dense = std::max<std::size_t>(2, points.size() / kDenseShare);
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    fence.lower[axis] -= side * below[a].dense_steps(dense);
    fence.upper[axis] += side * above[a].dense_steps(dense);
  }
  return fence;
}

bool contains(const Box& box, const Vec3& p) {
  return p.x >= box.lower.x && p.y >= box.lower.y && p.z >= box.lower.z && p.x <= box.upper.x &&
         p.y <= box.upper.y && p.z <= box.upper.z;
}

}  // namespace

Box robust_bounds(std::span<const Vec3> points) {
  if (points.empty()) return {};
  const Box middle = middle_half(points);
  // Most points at one place: they say nothing about the size of the rest.
  const bool has_size = middle.diagonal() > 0.0;
  const Box fence = has_size ? fence_around(points, middle) : Box{};
  Box bounds;
  for (const Vec3& p : points) {
    if (!has_size || contains(fence, p)) bounds.add(p);
  }
  return bounds;
}

Box robust_bounds(const Scene& scene) {
  Box bounds = robust_bounds(scene.points());
  for (const DrawItem& item : scene.draw_items()) {
    const auto* soup = std::get_if<DrawTriangles>(&item);
    if (soup == nullptr) continue;
    for (const Triangle& triangle : soup->triangles) {
      for (const std::uint32_t corner : triangle) {
        bounds.add(Vec3(soup->world_from_item * Vec4(Vec3(soup->positions[corner]), 1.0)));
      }
    }
  }
  return bounds;
}

}  // namespace rangezip
