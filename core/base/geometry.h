#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace rangezip {

using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;
using Vec4 = glm::dvec4;
using Mat3 = glm::dmat3;
using Mat4 = glm::dmat4;
using Vec3f = glm::vec3;

/// Three corner indices, counter-clockwise as seen from outside.
using Triangle = std::array<std::uint32_t, 3>;

/// An axis-parallel box; empty (lower > upper) until something is added.
struct Box {
  Vec3 lower{std::numeric_limits<double>::infinity()};
  Vec3 upper{-std::numeric_limits<double>::infinity()};

  [[nodiscard]] bool is_empty() const noexcept { return !(lower.x <= upper.x); }
  [[nodiscard]] Vec3 center() const noexcept { return 0.5 * (lower + upper); }
  /// Length of the diagonal, 0 for an empty box.
  [[nodiscard]] double diagonal() const noexcept {
    return is_empty() ? 0.0 : glm::length(upper - lower);
  }
  void add(const Vec3& point) noexcept {
    // Axis by axis, not in a loop: this way compilers keep the box in registers.
    lower = {point.x < lower.x ? point.x : lower.x, point.y < lower.y ? point.y : lower.y,
             point.z < lower.z ? point.z : lower.z};
    upper = {point.x > upper.x ? point.x : upper.x, point.y > upper.y ? point.y : upper.y,
             point.z > upper.z ? point.z : upper.z};
  }
  void add(const Box& box) noexcept {
    if (box.is_empty()) return;
    add(box.lower);
    add(box.upper);
  }

  friend bool operator==(const Box&, const Box&) = default;
};

/// A box that reaches so much farther on all sides.
[[nodiscard]] inline Box widened(Box box, double margin) noexcept {
  box.lower -= Vec3(margin);
  box.upper += Vec3(margin);
  return box;
}

/// Whether two boxes have a point in common.
[[nodiscard]] inline bool boxes_meet(const Box& a, const Box& b) noexcept {
  return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y &&
         b.lower.y <= a.upper.y && a.lower.z <= b.upper.z && b.lower.z <= a.upper.z;
}

/// The half-space dot(normal, p) + offset >= 0; what lies outside is cut away.
struct Plane {
  Vec3 normal{0.0, 0.0, 1.0};
  double offset = 0.0;  ///< in model units times the length of `normal`

  [[nodiscard]] double value(const Vec3& point) const noexcept {
    return glm::dot(normal, point) + offset;
  }

  friend bool operator==(const Plane&, const Plane&) = default;
};

/// Twice the area vector of a triangle: normal to it, counter-clockwise corners face the viewer.
[[nodiscard]] inline Vec3 area_vector(const Vec3& a, const Vec3& b, const Vec3& c) noexcept {
  return glm::cross(b - a, c - a);
}

/// Unit normal of a triangle, counter-clockwise; zero where it has no area.
[[nodiscard]] inline Vec3 unit_normal(const Vec3& a, const Vec3& b, const Vec3& c) noexcept {
  const Vec3 area = area_vector(a, b, c);
  const double length = glm::length(area);
  return length > 0.0 ? area / length : Vec3{0.0};
}

/// `vector` at unit length; (0, 0, 1) for a zero or non-finite one.
[[nodiscard]] inline Vec3 unit_or_z(const Vec3& vector) noexcept {
  const double length = glm::length(vector);
  return length > 0.0 && length < std::numeric_limits<double>::infinity() ? vector / length
                                                                          : Vec3{0.0, 0.0, 1.0};
}

/// The point of the triangle abc that is nearest to `point` [Ericson 2005, 5.1.5]. The triangle may
/// be as thin as it likes, a segment or a point. What is given lies on the triangle up to the
/// rounding of the coordinates, and no point is nearer by more than 1e-12 of the triangle's size.
[[nodiscard]] Vec3 closest_point_on_triangle(const Vec3& point, const Vec3& a, const Vec3& b,
                                             const Vec3& c) noexcept;

/// Of a point from closest_point_on_triangle().
[[nodiscard]] inline double squared_distance_to_triangle(const Vec3& point, const Vec3& a,
                                                         const Vec3& b, const Vec3& c) noexcept {
  const Vec3 offset = closest_point_on_triangle(point, a, b, c) - point;
  return glm::dot(offset, offset);
}

}  // namespace rangezip
