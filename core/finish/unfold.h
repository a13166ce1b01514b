#pragma once

#include <cstddef>

#include "core/base/progress.h"
#include "core/finish/point_grid.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

struct UnfoldOptions {
  double pixel_size = 0.0;  ///< h, model units
  double noise = 0.0;       ///< of the cloud, standard deviation, model units
};

/// Takes small folds out of a surface: where it turns by more than 120 degrees over up to eight
/// edges that hang together, as where two scans of places with few points lay over each other, the
/// faces around those go, and a smooth fill takes their place. It stays only if it has no fold, the
/// points of the cloud are no farther from it (in the mean of the squares, by more than the noise
/// and a tenth of a pixel; farther than 0.75 h none counts), and nothing crosses; else the faces
/// stay, as those of a knife's edge or a thin tip do, and longer folds. Vertices without faces are
/// left behind. Cost: linear, but for the folds.
/// @pre oriented, manifold (core/finish/clean_topology.h)
/// @return number of folds that are gone
/// @throws Cancelled if `progress` says so.
std::size_t unfold(TriangleMesh& mesh, const PointGrid& cloud, const UnfoldOptions& options,
                   const Progress& progress = {});

}  // namespace rangezip
