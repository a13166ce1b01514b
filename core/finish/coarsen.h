#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/progress.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

struct CoarsenOptions {
  std::size_t triangles = 0;  ///< as many are left, if collapses can reach it
  double tolerance = 0.0;  ///< model units: only collapses after which the faces stay within this
                           ///< of those before, by their root mean square; 0: any
  std::vector<std::uint8_t> is_kept;  ///< flags of vertices that stay where they are; empty: none
};

/// Takes as many triangles away as may be by collapsing edges, always the one that brings the faces
/// least off the surface, by the sum of squared distances from the planes of all faces that a
/// vertex stands for, by area [Garland, Heckbert 1997]; the vertex goes to where that is least. So
/// triangles become large where the surface is flat, long where it bends one way only, and edges
/// run along features. Boundaries are coarsened as well, and kept by planes that stand on them.
/// Collapses that make small angles come later, none makes one under 15 degrees; if `triangles`
/// cannot be reached so, under 5. No face turns by more than 60 degrees. May leave
/// self-intersections where sheets are close together. O(faces log faces), in one thread.
/// @pre oriented, manifold (core/finish/clean_topology.h)
/// @return edges that were collapsed
std::size_t coarsen(TriangleMesh& mesh, const CoarsenOptions& options,
                    const Progress& progress = {});

}  // namespace rangezip
