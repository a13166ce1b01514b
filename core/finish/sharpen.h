#pragma once

#include "core/base/progress.h"
#include "core/finish/finish.h"
#include "core/finish/point_grid.h"
#include "core/finish/snap_features.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// Makes edges, corners and rims sharp: moves vertices onto features (core/finish/snap_features.h);
/// cuts out and closes what crosses then; brings rims out to where the cloud has points
/// (core/finish/reach_points.h), twice, and brings out once more what snapping has taken back.
/// After each of these but the last it snaps again what is within three edges of what changed.
/// Snapping again cuts nothing out: where faces cross it is done anew without the vertices around,
/// and after four times left as it is. Without self-intersections before there are none after. Adds
/// to the counts of `report`.
/// @pre oriented, manifold (core/finish/clean_topology.h)
void sharpen(TriangleMesh& mesh, const PointGrid& cloud, const SnapOptions& snapping,
             const FinishOptions& options, FinishReport& report, const Progress& progress);

}  // namespace rangezip
