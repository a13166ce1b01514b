#pragma once

#include "core/image/grid_cells.h"
#include "core/image/range_image.h"
#include "core/mask/correspondence.h"
#include "core/mask/mask.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// Sampling quality of each active sample, model units, small is good: the longest edge from it to
/// its active grid neighbours over which triangulate() would build a triangle (by `cells`)
/// [Kobbelt, Botsch 2000, 4.3]; with `smooth`, the mean of that and of the longest side of a grid
/// cell at the sample's slope, h sqrt(2 + 1.5 slope^2), which varies less from pixel to pixel.
/// kNoSample where there is no such neighbour. O(pixels).
/// @throws InvalidArgument for different extents, like the functions below.
[[nodiscard]] Grid<double> sample_quality(const RangeImage& image, const SlopeImage& slopes,
                                          const Mask& active, bool smooth = true,
                                          const GridCellOptions& cells = {});

struct QualityMaskOptions {
  double hysteresis = 0.8;  ///< a sample replaces old surface if its quality is less than this
                            ///< times the old one; below 1 it avoids ragged borders
  double max_replacing_slope = kNoSample;  ///< samples steeper than this (tangent) never replace
};

/// Deactivates the samples that lie on a face of `mesh` which is sampled at least as well: its
/// quality (sampling_of(), its longest side unless it was decimated) times hysteresis is no larger
/// than the sample's. A sample on no face stays
/// active, since it extends the surface [Kobbelt, Botsch 2000, 4.3]; one seen from behind never.
[[nodiscard]] Mask keep_better_samples(const Grid<double>& quality, const SlopeImage& slopes,
                                       const Mask& active, const TriangleMesh& mesh,
                                       const Correspondence& correspondence,
                                       const QualityMaskOptions& options = {});

/// Only the samples that lie on no face, in connected pieces (8 neighbours) of at least
/// `min_pixels`: what a fill view may add, since the old surface has priority.
[[nodiscard]] Mask keep_unmatched_samples(const Mask& active, const Correspondence& correspondence,
                                          int min_pixels = 5);

}  // namespace rangezip
