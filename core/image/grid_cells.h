#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "core/base/grid.h"
#include "core/image/range_image.h"

namespace rangezip {

/// Which triangles of the pixel grid are taken.
struct GridCellOptions {
  double max_edge = kNoSample;  ///< in pixel sides; a triangle with a step of depth longer than
                                ///< max_edge * sqrt(2) pixel sides is left out
  double min_cosine = 0.0;  ///< of the angle between normal and line of sight; triangles below are
                            ///< left out, 0 takes all
};

/// The up to two triangles of each cell of the pixel grid. Cell (x, y) has the corners
/// a = (x, y), b = (x + 1, y), c = (x + 1, y + 1), d = (x, y + 1); the bits say which triangles
/// it has. The last row and column are empty.
using GridCells = Grid<std::uint8_t>;
inline constexpr std::uint8_t kLowerTriangle = 1;    ///< a b c, or a b d
inline constexpr std::uint8_t kUpperTriangle = 2;    ///< a c d, or b c d
inline constexpr std::uint8_t kFallingDiagonal = 4;  ///< the cell is cut from b to d, not a to c

/// Joins the samples of neighbouring active pixels: two triangles a cell, along the diagonal of the
/// smaller depth step, one where a corner is missing [Kobbelt, Botsch 2000, 2]. O(pixels).
/// @param active 1 where the sample takes part; pixels without a sample never do
[[nodiscard]] GridCells build_grid_cells(const RangeImage& image, const Mask& active,
                                         const GridCellOptions& options = {});

/// Corners, counter-clockwise in the window, of the lower or upper triangle of a cell.
/// @param bits the cell's; its diagonal decides
/// @param triangle kLowerTriangle or kUpperTriangle
[[nodiscard]] std::array<Pixel, 3> grid_triangle(Pixel cell, std::uint8_t bits,
                                                 std::uint8_t triangle);

/// Position of a sample in the eye's frame, where -z is eye depth.
/// @pre has_sample(pixel)
[[nodiscard]] Vec3 eye_position(const RangeImage& image, Pixel pixel);

/// Calls visit(corners) for each triangle of `cells` that has a corner at `pixel`.
template <class F>
void for_each_triangle_at(const GridCells& cells, Pixel pixel, const F& visit) {
  for (int y = std::max(0, pixel.y - 1); y <= pixel.y; ++y) {
    for (int x = std::max(0, pixel.x - 1); x <= pixel.x; ++x) {
      const std::uint8_t bits = cells[{x, y}];
      for (const std::uint8_t which : {kLowerTriangle, kUpperTriangle}) {
        if ((bits & which) == 0) continue;
        const std::array<Pixel, 3> corners = grid_triangle({x, y}, bits, which);
        if (corners[0] == pixel || corners[1] == pixel || corners[2] == pixel) visit(corners);
      }
    }
  }
}

}  // namespace rangezip
