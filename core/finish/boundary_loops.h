#pragma once

#include <cstdint>
#include <vector>

#include "core/finish/corner_table.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// A closed boundary in the direction of the faces that would fill it: for each edge the half-edge
/// (corner) of the face on the other side. The edge runs from the head of corners[i] to its vertex,
/// which is where the next edge begins.
struct BoundaryLoop {
  std::vector<std::uint32_t> corners;
};

/// All boundary loops, in order of the lowest corner in them; each starts there. O(faces).
/// @pre one fan a vertex (clean_topology())
[[nodiscard]] std::vector<BoundaryLoop> boundary_loops(const CornerTable& table);

/// The vertices of a loop in filling order: edge i runs from [i] to [i + 1].
[[nodiscard]] std::vector<std::uint32_t> vertices_of(const BoundaryLoop& loop,
                                                     const CornerTable& table);

/// Model units.
[[nodiscard]] double perimeter_of(const BoundaryLoop& loop, const CornerTable& table,
                                  const std::vector<Vec3>& positions);

}  // namespace rangezip
