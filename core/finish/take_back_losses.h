#pragma once

#include <cstddef>

#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// Takes back what was cleared in vain. A loop that cannot be closed, as where two walls touch or
/// cross, loses a ring of faces in each round of a repair (repair.h), and what is left open is no
/// crack any more, but a hole in a surface that scans have seen. Around loops that are open now,
/// and where nothing is left, the changes that hang together (by common vertices) are undone if of
/// the surface that went less than half came again, and 10 square h are lost, unless what comes
/// back crosses something new. So do components that were dropped.
/// Cost: some passes over the meshes.
/// @param before without faces that cross; its vertices may have other numbers
/// @param pixel_size h, model units
/// @return faces that came back
/// @pre both oriented, manifold (clean_topology.h); stays so. Vertices may get new numbers.
std::size_t take_back_losses(TriangleMesh& mesh, const TriangleMesh& before, double pixel_size);

}  // namespace rangezip
