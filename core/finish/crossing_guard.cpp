#include "core/finish/crossing_guard.h"

#include "core/base/spread.h"
#include "core/mesh/triangle_overlap.h"

namespace rangezip {

CrossingGuard::CrossingGuard(const TriangleMesh& mesh, double side) : mesh_(mesh), side_(side) {
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f)
    add(f);
}

template <class Visit>
void CrossingGuard::for_each_cube(const Box& box, const Visit& visit) const {
  const Cube lower = cube_of(box.lower, side_), upper = cube_of(box.upper, side_);
  for (std::int64_t z = lower[2]; z <= upper[2]; ++z) {
    for (std::int64_t y = lower[1]; y <= upper[1]; ++y) {
      for (std::int64_t x = lower[0]; x <= upper[0]; ++x)
        visit(Cube{x, y, z});
    }
  }
}

void CrossingGuard::add(std::uint32_t face) {
  const Triangle& t = mesh_.triangles[face];
  if (is_degenerate(mesh_, t)) return;  // crosses nothing
  for_each_cube(box_of(mesh_, t), [&](const Cube& cube) { faces_of_[cube].push_back(face); });
}

bool CrossingGuard::would_cross(const Triangle& face) const {
  const Box box = box_of(mesh_, face);
  bool crosses = false;
  for_each_cube(box, [&](const Cube& cube) {
    const auto found = faces_of_.find(cube);
    if (crosses || found == faces_of_.end()) return;
    for (const std::uint32_t other : found->second) {
      const Triangle& t = mesh_.triangles[other];
      crosses = crosses || (boxes_meet(box, box_of(mesh_, t)) && overlap(mesh_, face, t));
    }
  });
  return crosses;
}

}  // namespace rangezip
