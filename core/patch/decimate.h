#pragma once

#include "core/image/range_image.h"
#include "core/patch/patch.h"

namespace rangezip {

struct DecimateOptions {
  double tolerance = 0.05;  ///< in pixel sides along the line of sight, not negative: no sample is
                            ///< farther from the triangle that covers it
  int max_block = 32;       ///< cells along the side of the largest blocks, 1 to kMaxRasterExtent;
                            ///< the largest power of 2 that is no more counts
};

/// Merges cells of the pixel grid where the range image is flat: the decimation that
/// [Kobbelt, Botsch 2000, 5] names as future work, by a quad-tree over the grid.
///
/// A block of 2^k x 2^k cells becomes two triangles if all its samples lie within the tolerance of
/// them, and no side of it is steeper than 56 degrees. Blocks that touch, in an edge or a corner,
/// differ by at most a factor of 2 in side, so that triangles grow gradually from curved to flat,
/// and a block next to smaller ones has their vertices in the middles of its sides, which leaves no
/// cracks. Cells with a vertex on the boundary of the patch stay as they are: the stitch finds the
/// boundary at the full resolution.
///
/// Vertices are a subset of the patch's, in its order. The result covers the same cells.
/// O(pixels log(max_block)); rows of blocks run in parallel.
/// @param patch of triangulate() over `image`
/// @throws InvalidArgument if an option is out of range
[[nodiscard]] Patch decimate(const RangeImage& image, Patch patch, const DecimateOptions& options);

}  // namespace rangezip
