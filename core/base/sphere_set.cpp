#include "core/base/sphere_set.h"

#include <algorithm>
#include <cmath>

namespace rangezip {
namespace {

/// Of the largest coordinate: smaller cubes could not be numbered.
constexpr double kSmallestSide = 1e-12;

}  // namespace

SphereSet::SphereSet(std::span<const Sphere> spheres) {
  if (spheres.empty()) return;
  double largest = 0.0;
  for (const Sphere& sphere : spheres) {
    bounds_.add(sphere.center - Vec3(sphere.radius));
    bounds_.add(sphere.center + Vec3(sphere.radius));
    largest = std::max(largest, sphere.radius);
  }
  const Vec3 reach = glm::max(glm::abs(bounds_.lower), glm::abs(bounds_.upper));
  side_ = std::max(2.0 * largest, kSmallestSide * std::max({reach.x, reach.y, reach.z}));
  for (const Sphere& sphere : spheres) {
    const Cube lower = cube_of(sphere.center - Vec3(sphere.radius), side_);
    const Cube upper = cube_of(sphere.center + Vec3(sphere.radius), side_);
    for (Cube cube = lower; cube[2] <= upper[2]; ++cube[2]) {
      for (cube[1] = lower[1]; cube[1] <= upper[1]; ++cube[1]) {
        for (cube[0] = lower[0]; cube[0] <= upper[0]; ++cube[0])
          entries_.push_back({cube, sphere});
      }
    }
  }
  std::stable_sort(entries_.begin(), entries_.end(),
                   [](const Entry& a, const Entry& b) { return a.cube < b.cube; });
}

bool SphereSet::contains(const Vec3& point) const noexcept {
  const bool is_inside = glm::all(glm::greaterThanEqual(point, bounds_.lower)) &&
                         glm::all(glm::lessThanEqual(point, bounds_.upper));
  if (!is_inside) return false;
  const Cube cube = cube_of(point, side_);
  auto entry = std::lower_bound(entries_.begin(), entries_.end(), cube,
                                [](const Entry& e, const Cube& c) { return e.cube < c; });
  for (; entry != entries_.end() && entry->cube == cube; ++entry) {
    if (entry->sphere.contains(point)) return true;
  }
  return false;
}

}  // namespace rangezip
