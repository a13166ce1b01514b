#include "core/base/geometry.h"

#include <algorithm>

namespace rangezip {

namespace {

/// A point of the triangle abc, also as a + of_b (b - a) + of_c (c - a).
struct Foot {
  Vec3 position{0.0};
  double of_b = 0.0;
  double of_c = 0.0;
};

/// Where along the segment from u to v, in [0, 1], the nearest point to `point`
/// is.
double share_along(const Vec3& point, const Vec3& u, const Vec3& v) noexcept {
  const Vec3 uv = v - u;
  const double squared_length = glm::dot(uv, uv);
  const double along = glm::dot(uv, point - u);
  if (!(along > 0.0) || !(squared_length > 0.0)) return 0.0;
  return along < squared_length ? along / squared_length : 1.0;
}

Vec3 between(const Vec3& u, const Vec3& v, double share) noexcept {
  return share < 1.0 ? u + (v - u) * share : v;
}

double squared_distance(const Vec3& p, const Vec3& q) noexcept {
  return glm::dot(q - p, q - p);
}

Foot closest_point_on_edges(const Vec3& point, const Vec3& a, const Vec3& b,
                            const Vec3& c) noexcept {
  const double ab = share_along(point, a, b);
  const double bc = share_along(point, b, c);
  const double ac = share_along(point, a, c);
  Foot nearest{between(a, b, ab), ab, 0.0};
  for (const Foot& foot :
       {Foot{between(b, c, bc), 1.0 - bc, bc}, Foot{between(a, c, ac), 0.0, ac}}) {
    if (squared_distance(point, foot.position) < squared_distance(point, nearest.position)) {
      nearest = foot;
    }
  }
  return nearest;
}

/// For corners that are nearly or truly on a line.
Vec3 closest_point_on_sliver(const Vec3& point, const Vec3& a, const Vec3& b,
                             const Vec3& c) noexcept {
  const Foot edge = closest_point_on_edges(point, a, b, c);
  const Vec3 normal = area_vector(a, b, c);
  const double squared_area = glm::dot(normal, normal);
  if (!(squared_area > 0.0)) return edge.position;
  // The way from there to the face, no longer than the triangle is thin:
  // rounding errors, which grow with 1 / height, stay as small as the rounding
  // of the corners. Weights that are noise do no harm: a point with weights in
  // [0, 1] is on the triangle, and it is taken only if nearer.
  const Vec3 rest = point - edge.position;
  const double of_b = edge.of_b + glm::dot(glm::cross(rest, c - a), normal) / squared_area;
  const double of_c = edge.of_c + glm::dot(glm::cross(b - a, rest), normal) / squared_area;
  if (!(of_b >= 0.0 && of_c >= 0.0 && of_b + of_c <= 1.0)) return edge.position;
  const Vec3 on_face = a + (b - a) * of_b + (c - a) * of_c;
  return squared_distance(point, on_face) < squared_distance(point, edge.position) ? on_face
                                                                                   : edge.position;
}

}  // namespace

Vec3 closest_point_on_triangle(const Vec3& point, const Vec3& a, const Vec3& b,
                               const Vec3& c) noexcept {
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const double d1 = glm::dot(ab, point - a);
  const double d2 = glm::dot(ac, point - a);
  // Each branch is one Voronoi region of the triangle: corners, edges, then the face.
  if (d1 <= 0.0 && d2 <= 0.0) return a;

  // The rounding errors of the weights below grow with (longest edge / least height)^2. Thinner
  // than about 1 : 20, the triangle goes another way.
  constexpr double kSliver = 1e-3;
  const double ab_ab = glm::dot(ab, ab);
  const double ac_ac = glm::dot(ac, ac);
  const double ab_ac = glm::dot(ab, ac);
  const double squared_size = ab_ab + ac_ac;  // at least half of the longest edge squared
  if (!(ab_ab * ac_ac - ab_ac * ab_ac > kSliver * squared_size * squared_size)) {
    return closest_point_on_sliver(point, a, b, c);
  }

  const double d3 = glm::dot(ab, point - b);
  const double d4 = glm::dot(ac, point - b);
  if (d3 >= 0.0 && d4 <= d3) return b;

  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return d1 - d3 > 0.0 ? a + ab * (d1 / (d1 - d3)) : a;

  const double d5 = glm::dot(ab, point - c);
  const double d6 = glm::dot(ac, point - c);
  if (d6 >= 0.0 && d5 <= d6) return c;

  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return d2 - d6 > 0.0 ? a + ac * (d2 / (d2 - d6)) : a;

  const double va = d3 * d6 - d5 * d4;
  const double along_bc = (d4 - d3) + (d5 - d6);
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
    return along_bc > 0.0 ? b + (c - b) * ((d4 - d3) / along_bc) : b;
  }
  const double sum = va + vb + vc;
  return sum > 0.0 ? a + ab * (vb / sum) + ac * (vc / sum) : a;
}

}  // namespace rangezip
