#pragma once

#include "core/base/progress.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// Laplacian smoothing: in each iteration every vertex that is not on the boundary moves a share
/// `factor` of the way to the mean of its neighbours, all at once [Kobbelt, Botsch 2000, Fig. 9].
/// Connectivity and the order of vertices stay. O(iterations * faces).
/// @throws InvalidArgument if iterations is negative or factor is not in (0, 1]; Cancelled.
/// @throws TopologyError if the mesh is not manifold (check_mesh()).
[[nodiscard]] TriangleMesh laplacian_smooth(TriangleMesh mesh, int iterations, double factor = 0.5,
                                            const Progress& progress = {});

}  // namespace rangezip
