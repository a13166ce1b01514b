#include "core/mesh/drawable.h"

#include "core/base/parallel.h"

namespace rangezip {

DrawableMesh::DrawableMesh(const TriangleMesh& mesh)
    : triangles_(&mesh.triangles), positions_(mesh.positions.size()) {
  constexpr std::size_t kGrain = 1 << 14;
  const Box bounds = bounds_of(mesh);
  const Vec3 origin = bounds.is_empty() ? Vec3{0.0} : bounds.center();
  parallel_for(positions_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      positions_[i] = Vec3f(mesh.positions[i] - origin);
  });
  world_from_item_[3] = Vec4(origin, 1.0);
}

DrawTriangles DrawableMesh::item(Facing facing) const {
  return {.positions = positions_,
          .triangles = *triangles_,
          .world_from_item = world_from_item_,
          .facing = facing};
}

}  // namespace rangezip
