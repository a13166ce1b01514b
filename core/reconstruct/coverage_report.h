#pragma once

#include <cstddef>
#include <vector>

#include "core/finish/seen_points.h"
#include "core/mesh/places.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// What of the input the mesh does not show, and what of the mesh the input does not show.
struct CoverageReport {
  double share = 1.0;  ///< of the points that have a face within a pixel side
  std::size_t uncovered_points = 0;
  std::size_t scattered_points = 0;  ///< of these, in no place: outliers and the tails of noise
  /// That the places stand for, square model units; an estimate: each point stands for as much as
  /// covered ones on average, and those in a cube with pixel sides for two square pixels at most.
  double uncovered_area = 0.0;
  std::vector<Place> uncovered;    ///< such as pockets that no view can reach; largest first
  double unsupported_area = 0.0;   ///< of the places without points, square model units
  std::vector<Place> unsupported;  ///< such as holes that were closed; largest first
  double papered_area = 0.0;       ///< of the places across the air, square model units
  std::vector<Place> papered;      ///< through which points look out (core/finish/papered_faces.h)
};

/// Compares points with the mesh that was made of them. A face counts as supported if a point
/// lies within 1.5 pixel sides, or 1.5 mean spacings if that is more, of its centroid. Fewer than
/// ten points or faces together make no place, nor do points among others that have a face
/// (core/finish/left_out_points.h). O(points + faces).
/// @throws InvalidArgument if pixel_size is not positive and finite.
[[nodiscard]] CoverageReport report_coverage(const SeenPoints& seen, const TriangleMesh& mesh,
                                             double pixel_size);

}  // namespace rangezip
