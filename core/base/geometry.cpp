#include "core/base/geometry.h"

#include <algorithm>

namespace rangezip {

Vec3 closest_point_on_triangle(const Vec3& point, const Vec3& a, const Vec3& b,
                               const Vec3& c) noexcept {
  // Each branch is one Voronoi region of the triangle: corners, edges, then the face.
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const double d1 = glm::dot(ab, point - a);
  const double d2 = glm::dot(ac, point - a);
  if (d1 <= 0.0 && d2 <= 0.0) return a;

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
