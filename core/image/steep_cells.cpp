#include "core/image/steep_cells.h"

#include <string>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/image/grid_cells.h"

namespace rangezip {

Mask mark_steep_cells(const RangeImage& image, const SteepCellsOptions& options) {
  if (!(options.min_cosine > 0.0) || !(options.min_cosine <= 1.0)) {
    throw InvalidArgument("mark_steep_cells: min_cosine must lie in (0, 1], got " +
                          std::to_string(options.min_cosine));
  }
  const Mask samples(image.extent(), 1);  // pixels without one are left out by the cells
  const GridCells all = build_grid_cells(image, samples);
  const GridCells facing = build_grid_cells(image, samples, {.min_cosine = options.min_cosine});
  const auto has_triangle = [](const GridCells& cells, Pixel pixel) {
    bool any = false;
    for_each_triangle_at(cells, pixel, [&](const auto&) { any = true; });
    return any;
  };
  Mask steep(image.extent(), 0);
  for_each_row(image.extent().height, [&](int y) {
    for (Pixel p{0, y}; p.x < image.extent().width; ++p.x) {
      if (has_triangle(all, p) && !has_triangle(facing, p)) steep[p] = 1;
    }
  });
  return steep;
}

}  // namespace rangezip
