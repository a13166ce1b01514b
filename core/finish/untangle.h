#pragma once

#include <cstddef>

#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// Pulls faces apart that cross others by smoothing where they are: the inner vertices of crossing
/// faces move to the middle of their neighbours, from the third round on with those around them.
/// Most folds that moving vertices by themselves has made come apart so, without a hole to fill.
/// Ends when nothing crosses, or after six rounds. The topology and the boundary stay. Cost:
/// self_intersections() a round.
/// @return pairs that crossed at first
/// @pre oriented, manifold (core/finish/clean_topology.h)
std::size_t untangle(TriangleMesh& mesh);

}  // namespace rangezip
