#include "core/finish/places_near.h"

namespace rangezip {

bool is_near(const PointGrid& places, const Vec3& p, double radius) {
  bool found = false;
  places.for_each_near(p, radius, [&](const Vec3& offset) {
    found = found || glm::dot(offset, offset) <= radius * radius;
  });
  return found;
}

std::vector<Vec3> points_near(std::span<const Vec3> points, const PointGrid& places,
                              double radius) {
  const auto flags =
      flags_of(points.size(), [&](std::size_t i) { return is_near(places, points[i], radius); });
  std::vector<Vec3> near;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (flags[i] != 0) near.push_back(points[i]);
  }
  return near;
}

FacePart part_near(const TriangleMesh& mesh, const PointGrid& places, double radius) {
  return face_part(mesh, flags_of(mesh.triangles.size(), [&](std::size_t f) {
                     return is_near(places, mesh.positions[mesh.triangles[f][0]], radius);
                   }));
}

}  // namespace rangezip
