#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/base/geometry.h"
#include "core/finish/corner_table.h"
#include "core/finish/triangle_shape.h"

namespace rangezip {

// What turning or collapsing an edge does to the faces around it.

/// An inner edge a - b and the third corners of its faces (a, b, x) and (b, a, y), which
/// CornerTable::flip() makes (a, y, x) and (b, x, y).
struct Diamond {
  std::uint32_t a, b, x, y;

  /// @pre the half-edge of the corner is none of the boundary
  Diamond(const CornerTable& table, std::uint32_t corner)
      : a(table.vertex(corner)),
        b(table.head(corner)),
        x(table.apex(corner)),
        y(table.apex(table.across(corner))) {}
};

/// Twice the area vectors of a diamond's faces, before and after the edge has turned: those with
/// corners x and y, and those with corners a and b.
struct DiamondAreas {
  Vec3 old_x, old_y, new_a, new_b;

  DiamondAreas(const std::vector<Vec3>& p, const Diamond& d)
      : old_x(area_vector(p[d.a], p[d.b], p[d.x])),
        old_y(area_vector(p[d.b], p[d.a], p[d.y])),
        new_a(area_vector(p[d.a], p[d.y], p[d.x])),
        new_b(area_vector(p[d.b], p[d.x], p[d.y])) {}
};

/// Whether a diamond's faces, before and after the edge has turned, all look the same way.
[[nodiscard]] inline bool is_flat(const DiamondAreas& areas, double cosine) {
  return has_cosine(areas.old_x, areas.old_y, cosine) &&
         has_cosine(areas.new_a, areas.new_b, cosine) &&
         has_cosine(areas.new_a, areas.old_x, cosine);
}

/// Sine of the smallest angle of a diamond's two faces.
[[nodiscard]] inline double angle_before_flip(const std::vector<Vec3>& p, const Diamond& d) {
  return std::min(sine_of_smallest_angle(p[d.a], p[d.b], p[d.x]),
                  sine_of_smallest_angle(p[d.b], p[d.a], p[d.y]));
}
/// The same once the edge has turned.
[[nodiscard]] inline double angle_after_flip(const std::vector<Vec3>& p, const Diamond& d) {
  return std::min(sine_of_smallest_angle(p[d.a], p[d.y], p[d.x]),
                  sine_of_smallest_angle(p[d.b], p[d.x], p[d.y]));
}

/// Calls visit(p, q) for each face (v, p, q) around the half-edge's vertex v that is left when
/// CornerTable::collapse() moves v into the head: it becomes (head, p, q).
template <class Visit>
void for_each_face_after_collapse(const CornerTable& table, std::uint32_t corner, Visit visit) {
  const std::uint32_t head = table.head(corner);
  table.for_each_corner(table.vertex(corner), [&](std::uint32_t c) {
    const std::uint32_t p = table.head(c), q = table.apex(c);
    if (p != head && q != head) visit(p, q);
  });
}

}  // namespace rangezip
