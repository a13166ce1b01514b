#pragma once

#include <cstddef>
#include <span>

#include "core/base/progress.h"
#include "core/finish/grow_over.h"
#include "core/finish/point_grid.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// Lets fronts start again where they are stuck (own). Where points are sparse, a front now and
/// then takes a step that others do not fit to, and leaves a ragged loop: in a narrow hole such a
/// loop runs from wall to wall, and whoever closes it later papers over the hole. So around loops
/// of five edges or more the faces within 1 to 2.5 h go, and fronts grow there again, up to eight
/// times, each with another distance between points and another radius. What comes is taken, place
/// by place, if it has no less area (95 %), no more points are missing, and of the ragged border
/// less than 85 % is left, where an edge counts as its length times that of its loop. True borders,
/// grown again, have about as much as before, and stay as they are. Places are what has changed in
/// cubes of 2 h that touch. Cost: for each time, that of growing over the surroundings of the loops
/// (8 h).
/// @param points of the surface, those that the mesh shows among them
/// @param grown places within 3 h of which fronts may be stuck
/// @return faces that came less those that went; 0 at least
/// @pre oriented and manifold, but for vertices with several fans; stays so. Vertices keep their
///     numbers, also those that no face is left of.
std::size_t restart_fronts(TriangleMesh& mesh, std::span<const Vec3> points, const PointGrid& grown,
                           const GrowOverOptions& options, const Progress& progress = {});

}  // namespace rangezip
