#pragma once

#include <cstddef>

#include "core/base/progress.h"
#include "core/finish/point_grid.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

struct ReachPointsOptions {
  double pixel_size = 0.0;  ///< h, model units; positive
  double edge = 0.0;        ///< mean length of edges, model units; positive
  double noise = 0.0;       ///< standard deviation of the points from the surface, model units
};

/// Brings sharp rims, tips and corners out to where the cloud has points. Near the rim of a blade
/// no scan sees both sides, and what closes the mesh there cuts the rim off. Where points lie off
/// the mesh near a crease of 60 degrees or more, by 0.25 h or more and three times the noise, the
/// vertex next to them moves to the farthest of them, or half of the way, if the points around are
/// then nearer to the faces (by a tenth of the sum of squares), the smallest angle around does not
/// fall if it is under 11 degrees, no face folds over, and no more centroids and middles of sides
/// lie in the air. Moves by which faces cross are taken back. Edges that got long are split, and
/// edges turned within a side for better angles, now and then so that faces cross
/// (core/finish/separate.h); so the next round gets farther. At last single vertices that stick out
/// of their surroundings (core/finish/angle_defect.h) go back toward their neighbours, where the
/// points around do not clearly (by 30 %) speak for them: where scans lie in layers, the farthest
/// layer has a few points here and there. Clouds with noise of over h / 8 are left alone. The
/// topology and the boundary stay. Cost: the points within 2 h of those to be
/// reached, and the faces within 8 h; in up to ten rounds again those near what has moved.
/// @return moves that were made
/// @throws Cancelled if `progress` says so.
/// @pre oriented, manifold (core/finish/clean_topology.h); nothing crosses
std::size_t reach_points(TriangleMesh& mesh, const PointGrid& cloud,
                         const ReachPointsOptions& options, const Progress& progress = {});

}  // namespace rangezip
