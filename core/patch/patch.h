#pragma once

#include <vector>

#include "core/image/grid_cells.h"
#include "core/image/range_image.h"
#include "core/mask/mask.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// The surface that one scan adds, before it is joined to anything: a piece of the pixel grid
/// lifted to the samples. All triangles run counter-clockwise in the window.
struct Patch {
  TriangleMesh mesh;
  std::vector<Pixel> pixels;  ///< vertex i is the sample of pixels[i]
  GridCells cells;            ///< what the triangles cover; these are larger than cells only after
                              ///< decimate(), where there are blocks of whole cells
};

/// Drops vertices that no triangle uses, with their pixels, keeping the order of the others.
void remove_unused_vertices(Patch& patch);

/// Sides of pixels at the samples of a patch, model units.
struct PixelSides {
  double smallest = kNoSample;  ///< of no samples
  double largest = 0.0;         ///< the same
};
/// @param image that the patch was made of
[[nodiscard]] PixelSides pixel_sides_of(const Patch& patch, const RangeImage& image);

struct TriangulateOptions {
  double max_edge = kNoSample;    ///< in pixel sides; cells with a step of depth longer than
                                  ///< max_edge * sqrt(2) pixel sides stay open
  double max_slope_cosine = 0.0;  ///< triangles with a smaller cosine between normal and line of
                                  ///< sight stay open; 0: all are kept
  std::size_t min_component = 1;  ///< pieces with fewer triangles are dropped
};

/// The part of the options that decides on single triangles.
[[nodiscard]] inline GridCellOptions grid_cell_options(const TriangulateOptions& options) {
  return {.max_edge = options.max_edge, .min_cosine = options.max_slope_cosine};
}

/// The triangles of the grid as a patch: vertices numbered row by row, faces cell by cell.
/// O(pixels).
/// @pre all corners have samples
[[nodiscard]] Patch patch_from_cells(const RangeImage& image, GridCells cells);

/// Joins active samples of neighbouring pixels to triangles: two a cell, along the diagonal of
/// the smaller depth step, one where a corner is missing. The neighbourhood of the samples is that
/// of the pixels, so no search is needed [Kobbelt, Botsch 2000, 2].
///
/// Vertices are numbered row by row and faces cell by cell: the same input gives the same
/// numbering everywhere. The result is manifold: of cells that touch in one vertex only (bow
/// ties) the largest fan stays. O(pixels).
[[nodiscard]] Patch triangulate(const RangeImage& image, const Mask& active,
                                const TriangulateOptions& options = {});

}  // namespace rangezip
