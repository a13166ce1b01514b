#pragma once

#include <algorithm>
#include <cmath>

#include "core/base/geometry.h"

namespace rangezip {

/// Sine of the smallest angle of a triangle, 0 to sqrt(3)/2: twice the area over the product of the
/// two longest sides. 0 for one without area.
[[nodiscard]] inline double sine_of_smallest_angle(const Vec3& a, const Vec3& b,
                                                   const Vec3& c) noexcept {
  const Vec3 ab = b - a, bc = c - b, ca = a - c;
  const double s1 = glm::dot(ab, ab), s2 = glm::dot(bc, bc), s3 = glm::dot(ca, ca);
  const double shortest = std::min({s1, s2, s3});
  const double product = shortest == s1 ? s2 * s3 : shortest == s2 ? s1 * s3 : s1 * s2;
  if (!(product > 0.0)) return 0.0;
  const Vec3 area = glm::cross(ab, -ca);
  return std::sqrt(glm::dot(area, area) / product);
}

/// Whether the angle between two vectors of any length has at least this cosine (0 to 1).
[[nodiscard]] inline bool has_cosine(const Vec3& a, const Vec3& b, double cosine) noexcept {
  const double dot = glm::dot(a, b);
  return dot >= 0.0 && dot * dot >= cosine * cosine * glm::dot(a, a) * glm::dot(b, b);
}

}  // namespace rangezip
