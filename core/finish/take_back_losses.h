#pragma once

#include <cstddef>

#include "core/base/progress.h"
#include "core/finish/point_grid.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// Takes back what was cleared in vain. A loop that cannot be closed, as where two walls touch or
/// cross, loses a ring of faces in each round of a repair (repair.h), and a front (regrow.h) that
/// does not come back leaves open what was cleared for it: no crack any more, but a hole in a
/// surface that scans have seen. Around loops that are open now, and where nothing is left, the
/// changes that hang together (by common vertices) are undone if of the surface that went less than
/// half came again, and 10 square h are lost, unless what comes back crosses something new. So do
/// components that were dropped. With a cloud only if they also leave out over 40 points more than
/// they reach: points within 0.7 h of the faces before and of none after, and the other way round.
/// Cost: some passes over the meshes and the cloud.
/// @param before without faces that cross; its vertices may have other numbers
/// @param cloud null where walls are so close that points do not tell which of them they are of
/// @param pixel_size h, model units
/// @return faces that came back
/// @throws Cancelled if `progress` says so.
/// @pre both oriented, manifold (clean_topology.h); stays so. Vertices may get new numbers.
std::size_t take_back_losses(TriangleMesh& mesh, const TriangleMesh& before, const PointGrid* cloud,
                             double pixel_size, const Progress& progress = {});

/// The same for components of which nothing is left, such as the two sides of a thin body that are
/// too close to be joined: ring by ring, the rounds of a repair take them away altogether.
std::size_t take_back_vanished(TriangleMesh& mesh, const TriangleMesh& before,
                               const PointGrid& cloud, double pixel_size,
                               const Progress& progress = {});

}  // namespace rangezip
