#pragma once

#include <vector>

#include "core/mesh/triangle_mesh.h"
#include "core/raster/draw_item.h"

namespace rangezip {

/// A mesh in the form that a rasterizer takes: floats about a local origin, so that large world
/// coordinates lose nothing. A copy of the positions; the triangles stay the mesh's own.
class DrawableMesh {
 public:
  /// @param mesh must outlive this object and keep its triangles
  explicit DrawableMesh(const TriangleMesh& mesh);

  /// The whole mesh as one item; the id of a triangle is its index. Valid while this object lives.
  [[nodiscard]] DrawTriangles item(Facing facing = Facing::both) const;

 private:
  const std::vector<Triangle>* triangles_;
  std::vector<Vec3f> positions_;
  Mat4 world_from_item_{1.0};
};

}  // namespace rangezip
