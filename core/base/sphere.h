#pragma once

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

}  // namespace rangezip
