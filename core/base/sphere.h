#pragma once

#include <algorithm>
#include <span>

#include "core/base/geometry.h"

namespace rangezip {

/// A place and all around it up to a distance.
struct Sphere {
  Vec3 center{0.0};
  double radius = 0.0;

  [[nodiscard]] bool contains(const Vec3& point) const noexcept {
    const Vec3 offset = point - center;
    return glm::dot(offset, offset) <= radius * radius;
  }

  friend bool operator==(const Sphere&, const Sphere&) = default;
};

/// Whether one of the spheres holds the point.
[[nodiscard]] inline bool is_in_any(std::span<const Sphere> spheres, const Vec3& point) noexcept {
  return std::any_of(spheres.begin(), spheres.end(),
                     [&](const Sphere& sphere) { return sphere.contains(point); });
}

}  // namespace rangezip
