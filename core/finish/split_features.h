#pragma once

#include <cstddef>

#include "core/finish/feature_mesh.h"

namespace rangezip {

/// Splits edges between clean sides of a feature, none of whose ends is on it, where the sides meet
/// (no farther from the edge, up to 3 h, than the tip of a wedge as sharp is from a line across it)
/// and the points lie on them; none next to a vertex that is on the feature already (0.35 h).
/// @return how many. Cost: one pass over the edges, and the points around those that cross.
std::size_t split_crossing_edges(FeatureMesh& mesh, const FeatureCloud& cloud);

/// Splits the longest edge of faces whose three vertices are on edges of features, at the corner
/// where the three sides meet that meet in pairs at their vertices, if the points lie on these and
/// no vertex is there yet.
/// @return how many. Cost: one pass over the faces, and the points around those that cut a corner.
std::size_t split_cut_corners(FeatureMesh& mesh, const FeatureCloud& cloud);

}  // namespace rangezip
