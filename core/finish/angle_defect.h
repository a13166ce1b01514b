#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "core/base/geometry.h"
#include "core/finish/corner_table.h"

namespace rangezip {

/// What the angles of the faces around an inner vertex lack of a whole turn, radians: the Gaussian
/// curvature that is united there; negative at saddles. 0 on the boundary.
[[nodiscard]] inline double angle_defect(const CornerTable& table,
                                         const std::vector<Vec3>& positions, std::uint32_t vertex) {
  if (table.is_boundary(vertex)) return 0.0;
  double sum = 0.0;
  table.for_each_corner(vertex, [&](std::uint32_t c) {
    const Vec3 a = positions[table.head(c)] - positions[vertex];
    const Vec3 b = positions[table.apex(c)] - positions[vertex];
    sum += std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
  });
  return 2.0 * std::numbers::pi - sum;
}

/// What cancels out of the angle defects of a vertex and its neighbours, radians: next to nothing
/// on smooth sheets, along creases and at corners, which bend one way; much at a vertex that sticks
/// out alone, whose neighbours are saddles.
[[nodiscard]] inline double roughness_around(const CornerTable& table,
                                             const std::vector<Vec3>& positions,
                                             std::uint32_t vertex) {
  double sum = angle_defect(table, positions, vertex);
  double magnitude = std::abs(sum);
  table.for_each_neighbor(vertex, [&](std::uint32_t w) {
    const double defect = angle_defect(table, positions, w);
    sum += defect;
    magnitude += std::abs(defect);
  });
  return magnitude - std::abs(sum);
}

}  // namespace rangezip
