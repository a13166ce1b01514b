#include "core/mesh/triangle_overlap.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/mesh/exact_predicates.h"

namespace rangezip {
namespace {

using Corners = std::array<Vec3, 3>;
using Corners2d = std::array<Vec2, 3>;

Corners corners_of(const TriangleMesh& mesh, const Triangle& t) {
  return {mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
}

int side_of(const Corners& plane, const Vec3& point) {
  return orientation_3d(plane[0], plane[1], plane[2], point);
}

/// Drops the coordinate axis: the other two in cyclic order.
Vec2 dropped(const Vec3& p, int axis) {
  return {p[(axis + 1) % 3], p[(axis + 2) % 3]};
}

/// The axis to drop so that a triangle keeps an area: the largest component of its normal, or the
/// next one where rounding hid that it is exactly zero.
int axis_to_drop(const Corners& t) {
  const Vec3 normal = area_vector(t[0], t[1], t[2]);
  std::array<int, 3> axes{0, 1, 2};
  std::stable_sort(axes.begin(), axes.end(),
                   [&](int i, int j) { return std::abs(normal[i]) > std::abs(normal[j]); });
  for (const int axis : axes) {
    if (orientation_2d(dropped(t[0], axis), dropped(t[1], axis), dropped(t[2], axis)) != 0) {
      return axis;
    }
  }
  return axes[0];
}

bool is_inside(const Corners2d& t, int orientation, const Vec2& p) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (orientation_2d(t[i], t[(i + 1) % 3], p) == -orientation) return false;
  }
  return true;
}

/// p lies on the line ab: also between a and b?
bool is_between(const Vec2& a, const Vec2& b, const Vec2& p) {
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

bool segments_meet(const Vec2& a, const Vec2& b, const Vec2& p, const Vec2& q) {
  const int p_side = orientation_2d(a, b, p);
  const int q_side = orientation_2d(a, b, q);
  const int a_side = orientation_2d(p, q, a);
  const int b_side = orientation_2d(p, q, b);
  if (p_side * q_side < 0 && a_side * b_side < 0) return true;
  return (p_side == 0 && is_between(a, b, p)) || (q_side == 0 && is_between(a, b, q)) ||
         (a_side == 0 && is_between(p, q, a)) || (b_side == 0 && is_between(p, q, b));
}

bool segment_meets_triangle_2d(const Corners2d& t, const Vec2& p, const Vec2& q) {
  const int orientation = orientation_2d(t[0], t[1], t[2]);
  if (is_inside(t, orientation, p) || is_inside(t, orientation, q)) return true;
  for (std::size_t i = 0; i < 3; ++i) {
    if (segments_meet(t[i], t[(i + 1) % 3], p, q)) return true;
  }
  return false;
}

/// Everything in one plane.
bool segment_meets_triangle_in_plane(const Corners& t, const Vec3& p, const Vec3& q) {
  const int axis = axis_to_drop(t);
  const Corners2d flat{dropped(t[0], axis), dropped(t[1], axis), dropped(t[2], axis)};
  return segment_meets_triangle_2d(flat, dropped(p, axis), dropped(q, axis));
}

/// Closed segment pq against closed triangle; the sides of p and q on its plane are known.
bool segment_meets_triangle(const Corners& t, const Vec3& p, int p_side, const Vec3& q,
                            int q_side) {
  if (p_side * q_side > 0) return false;
  if (p_side == 0 && q_side == 0) return segment_meets_triangle_in_plane(t, p, q);
  int turn = 0;  // how the line pq passes the sides: all on the same hand, or it misses
  for (std::size_t i = 0; i < 3; ++i) {
    const int hand = orientation_3d(p, q, t[i], t[(i + 1) % 3]);
    if (hand * turn < 0) return false;
    if (hand != 0) turn = hand;
  }
  return true;
}

bool any_side_meets(const Corners& t, const Corners& other, const std::array<int, 3>& sides) {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    if (segment_meets_triangle(t, other[i], sides[i], other[j], sides[j])) return true;
  }
  return false;
}

bool all_on_one_side(const std::array<int, 3>& sides) {
  return sides[0] != 0 && sides[0] == sides[1] && sides[0] == sides[2];
}

bool triangles_meet_in_plane(const Corners& a, const Corners& b) {
  const int axis = axis_to_drop(a);
  const Corners2d flat_a{dropped(a[0], axis), dropped(a[1], axis), dropped(a[2], axis)};
  const Corners2d flat_b{dropped(b[0], axis), dropped(b[1], axis), dropped(b[2], axis)};
  for (std::size_t i = 0; i < 3; ++i) {
    if (segment_meets_triangle_2d(flat_a, flat_b[i], flat_b[(i + 1) % 3])) return true;
  }
  return is_inside(flat_b, orientation_2d(flat_b[0], flat_b[1], flat_b[2]), flat_a[0]);
}

/// No common corner: two triangles meet if a side of one meets the other.
bool separate_triangles_meet(const Corners& a, const Corners& b) {
  const std::array<int, 3> b_sides{side_of(a, b[0]), side_of(a, b[1]), side_of(a, b[2])};
  if (all_on_one_side(b_sides)) return false;
  if (b_sides[0] == 0 && b_sides[1] == 0 && b_sides[2] == 0) return triangles_meet_in_plane(a, b);
  const std::array<int, 3> a_sides{side_of(b, a[0]), side_of(b, a[1]), side_of(b, a[2])};
  if (all_on_one_side(a_sides)) return false;
  return any_side_meets(a, b, b_sides) || any_side_meets(b, a, a_sides);
}

/// Corner i of each of the two is the same vertex.
bool opposite_side_meets(const Corners& t, const Corners& other, std::size_t shared) {
  const Vec3& p = other[(shared + 1) % 3];
  const Vec3& q = other[(shared + 2) % 3];
  return segment_meets_triangle(t, p, side_of(t, p), q, side_of(t, q));
}

/// Triangles p q r and p q s (in any direction) fold onto each other.
bool folded_over_edge(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s) {
  if (orientation_3d(p, q, r, s) != 0) return false;
  const int axis = axis_to_drop({p, q, r});
  const Vec2 from = dropped(p, axis);
  const Vec2 to = dropped(q, axis);
  return orientation_2d(from, to, dropped(r, axis)) == orientation_2d(from, to, dropped(s, axis));
}

}  // namespace

bool is_degenerate(const TriangleMesh& mesh, const Triangle& triangle) noexcept {
  return are_collinear(mesh.positions[triangle[0]], mesh.positions[triangle[1]],
                       mesh.positions[triangle[2]]);
}

bool overlap(const TriangleMesh& mesh, const Triangle& first, const Triangle& second) noexcept {
  std::array<std::size_t, 3> in_first{};
  std::array<std::size_t, 3> in_second{};
  std::size_t shared = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (first[i] != second[j]) continue;
      in_first[shared] = i;
      in_second[shared] = j;
      ++shared;
      break;
    }
  }
  if (shared == 3) return true;
  const Corners a = corners_of(mesh, first);
  const Corners b = corners_of(mesh, second);
  if (shared == 0) return separate_triangles_meet(a, b);
  if (shared == 1) {
    return opposite_side_meets(a, b, in_second[0]) || opposite_side_meets(b, a, in_first[0]);
  }
  return folded_over_edge(a[in_first[0]], a[in_first[1]], a[3 - in_first[0] - in_first[1]],
                          b[3 - in_second[0] - in_second[1]]);
}

}  // namespace rangezip
