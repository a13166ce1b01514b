#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/finish/corner_table.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// Makes a mesh oriented and manifold by dropping as few faces as simple rules allow: those that
/// repeat a corner, those that use a directed edge that an earlier face has, and at a vertex with
/// several fans all but the fan with most faces (the earliest of equals).
/// Positions stay, unused ones too. O(faces). @return faces dropped
std::size_t clean_topology(TriangleMesh& mesh);

struct DroppedComponents {
  std::size_t components = 0;
  std::size_t faces = 0;
};

/// Drops the components (joined over shared edges) with fewer than `min_faces` faces, and shreds:
/// open ones with less than a two-hundredth of the faces of the largest component, which are
/// pieces of walls in pockets that no view connects. A sheet has no pockets if its area vector is
/// at least half its area (it is flatter than half a sphere): beside it they are things of their
/// own, such as roofs over a ground, and stay. The largest one (the earliest of equals) always
/// stays. With 0 all stay. Positions stay.
/// @param table of the mesh, as it is before
/// @param component of each face: components_of(table)
/// @pre oriented and manifold
DroppedComponents drop_small_components(TriangleMesh& mesh, const CornerTable& table,
                                        const std::vector<std::uint32_t>& component,
                                        std::size_t min_faces);

}  // namespace rangezip
