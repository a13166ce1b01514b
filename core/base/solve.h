#pragma once

#include <optional>

#include "core/base/geometry.h"

namespace rangezip {

/// x with m x = right, by Cramer's rule; nothing if the determinant of m is not above `least`,
/// which is not negative. For matrices of least squares, whose determinant tells how well x is
/// known.
[[nodiscard]] inline std::optional<Vec3> solve(const Mat3& m, const Vec3& right,
                                               double least) noexcept {
  const Vec3 of_x = glm::cross(m[1], m[2]);
  const Vec3 of_y = glm::cross(m[2], m[0]);
  const Vec3 of_z = glm::cross(m[0], m[1]);
  const double determinant = glm::dot(m[0], of_x);
  if (!(determinant > least)) return std::nullopt;
  return Vec3(glm::dot(right, of_x), glm::dot(right, of_y), glm::dot(right, of_z)) / determinant;
}

}  // namespace rangezip
