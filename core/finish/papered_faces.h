#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/finish/point_grid.h"
#include "core/finish/seen_points.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// Finds places where faces lie across the air, against what the input says, whoever made them:
/// scans that join samples across a step of depth, strips of stitches, fills of holes (own). Such a
/// face has no point near its centroid (is_supported(), kFaceSupport), and the first points that
/// lie straight behind it, into the object, look out through it: their mean vote has a cosine of
/// more than 0.25 with its normal. Behind a face of the surface, and behind one over a place that
/// was not measured, is the far side of the object, which looks the other way. No face is told so
/// by points that lie within 1.75 h behind it, nor by some that have no votes (area samples of
/// polygons) or that hardly any direction sees (votes under 0.05). Only faces count that hang
/// together, over shared edges, and cover 3 h^2 or more, as much as a hole 2 h across: less is left
/// without points here and there. O(faces), in parallel; what is in the air takes a walk through
/// the object.
/// @param cloud grid of the same points
/// @param pixel_size h, model units; positive
/// @return flags of faces; empty where there are no votes
[[nodiscard]] std::vector<std::uint8_t> papered_faces(const TriangleMesh& mesh,
                                                      const PointGrid& cloud,
                                                      const SeenPoints& seen, double pixel_size);

/// Drops such faces, but for holes that would be closed again: if there is a `least_rim` (model
/// units), those that hang together with a rim up to that, or less than a pixel side wide. The mesh
/// stays oriented and manifold. @return how many went
std::size_t drop_papered_faces(TriangleMesh& mesh, const PointGrid& cloud, const SeenPoints& seen,
                               double pixel_size, std::optional<double> least_rim = {});

}  // namespace rangezip
