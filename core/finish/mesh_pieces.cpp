#include "core/finish/mesh_pieces.h"

#include <utility>

#include "core/finish/components.h"

namespace rangezip {

MeshPieces pieces_of(const TriangleMesh& mesh) {
  CornerTable table(mesh.triangles, mesh.positions.size());
  std::vector<BoundaryLoop> loops = boundary_loops(table);
  std::vector<std::uint32_t> component = components_of(table);
  return {std::move(table), std::move(loops), std::move(component)};
}

}  // namespace rangezip
