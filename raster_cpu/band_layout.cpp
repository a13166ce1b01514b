#include "raster_cpu/band_layout.h"

#include <cassert>

#include "raster_cpu/fragment.h"

namespace rangezip {

BandLayout make_band_layout(Extent extent, int point_size) {
  constexpr std::size_t kWantedPixels = std::size_t{1} << 16;
  BandLayout layout{.extent = extent, .margin = point_size - 1, .rows_log2 = 0};
  const auto next = [&] {
    BandLayout higher = layout;
    ++higher.rows_log2;
    return higher;
  };
  // High bands where the margin is wide: points that hang over are drawn twice.
  while (layout.rows() < 4 * layout.margin || next().tile_pixels() <= kWantedPixels) {
    if (layout.rows() >= extent.height) break;
    layout = next();
  }
  assert(layout.tile_pixels() <= kMaxTilePixels);
  return layout;
}

}  // namespace rangezip
