#pragma once

#include <cstdint>
#include <vector>

#include "core/finish/boundary_loops.h"
#include "core/finish/corner_table.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// What a mesh hangs together by: one look at it serves the steps of a repair until one of them
/// changes a face.
struct MeshPieces {
  CornerTable table;
  std::vector<BoundaryLoop> loops;
  std::vector<std::uint32_t> component;  ///< of each face; see components_of()
};

/// O(faces). @pre oriented, manifold (clean_topology())
[[nodiscard]] MeshPieces pieces_of(const TriangleMesh& mesh);

}  // namespace rangezip
