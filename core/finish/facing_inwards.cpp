#include "core/finish/facing_inwards.h"

#include <cmath>

#include "core/base/parallel.h"
#include "core/finish/box_tree.h"

namespace rangezip {
namespace {

constexpr double kGrazes = 0.3;  ///< cosine of ray and normal
constexpr std::size_t kGrain = 64;

/// Twice the area of a triangle in the plane across an axis, signed.
double area_across(int axis, const Vec3& a, const Vec3& b, const Vec3& c) {
  const int x = (axis + 1) % 3, y = (axis + 2) % 3;
  return (b[x] - a[x]) * (c[y] - a[y]) - (b[y] - a[y]) * (c[x] - a[x]);
}

/// Whether the line through a point along an axis goes through a face, and that in the direction of
/// the axis or against it.
bool is_on_ray(const TriangleMesh& mesh, const Triangle& face, const Vec3& from, int axis,
               bool is_forward) {
  const Vec3 &a = mesh.positions[face[0]], &b = mesh.positions[face[1]],
             &c = mesh.positions[face[2]];
  const double at_a = area_across(axis, from, b, c), at_b = area_across(axis, from, c, a),
               at_c = area_across(axis, from, a, b);
  const bool is_inside = (at_a < 0.0) == (at_b < 0.0) && (at_b < 0.0) == (at_c < 0.0);
  if (!is_inside) return false;
  const double sum = at_a + at_b + at_c;
  if (sum == 0.0) return false;  // edge on
  const double place = (at_a * a[axis] + at_b * b[axis] + at_c * c[axis]) / sum;
  return is_forward ? place > from[axis] : place < from[axis];
}

/// Faces that a ray goes through, but for the one that it starts from.
std::size_t count_on_ray(const TriangleMesh& mesh, const BoxTree& boxes, const Box& bounds,
                         std::uint32_t start, const Vec3& from, int axis, bool is_forward) {
  Box ray;
  ray.add(from);
  Vec3 end = from;
  end[axis] = is_forward ? bounds.upper[axis] : bounds.lower[axis];
  ray.add(end);
  std::size_t count = 0;
  for (const std::uint32_t f : boxes.meeting(ray)) {
    if (f != start && is_on_ray(mesh, mesh.triangles[f], from, axis, is_forward)) ++count;
  }
  return count;
}

bool faces_inwards(const TriangleMesh& mesh, const BoxTree& boxes, const Box& bounds,
                   std::uint32_t face) {
  const Vec3 from = centroid_of(mesh.positions, mesh.triangles[face]);
  const Vec3 normal = unit_normal(mesh.positions, mesh.triangles[face]);
  int inwards = 0;
  int outwards = 0;
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool is_forward : {false, true}) {
      const double cosine = is_forward ? normal[axis] : -normal[axis];
      if (!(std::abs(cosine) > kGrazes)) continue;
      const bool is_odd = count_on_ray(mesh, boxes, bounds, face, from, axis, is_forward) % 2 == 1;
      ++(is_odd == (cosine > 0.0) ? inwards : outwards);
    }
  }
  return inwards > outwards;
}

}  // namespace

std::vector<std::uint8_t> faces_facing_inwards(const TriangleMesh& mesh,
                                               std::span<const std::uint32_t> faces) {
  std::vector<Box> boxes;
  boxes.reserve(mesh.triangles.size());
  for (const Triangle& face : mesh.triangles)
    boxes.push_back(box_of(mesh, face));
  const BoxTree tree(boxes);
  const Box bounds = bounds_of(mesh);
  std::vector<std::uint8_t> flags(mesh.triangles.size(), 0);
  parallel_for(faces.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      flags[faces[i]] = faces_inwards(mesh, tree, bounds, faces[i]) ? 1 : 0;
  });
  return flags;
}

}  // namespace rangezip
