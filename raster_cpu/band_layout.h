#pragma once

#include <cstddef>

#include "core/base/grid.h"
#include "raster_cpu/fixed_point.h"

namespace rangezip {

/// Largest size of the points that go through bins: small beside a band.
inline constexpr int kMaxBinnedSize = 5;

/// How an image is cut into bands of whole rows. Each is drawn in a tile of its own: its pixels and
/// a margin around them, which takes what hangs over the band and is dropped. So nothing is clipped
/// while a tile is drawn, and it stays in the second-level cache: 512 KB, up to 2 MB where the
/// image is wide and the margin makes the band high (R12 needs as much again).
struct BandLayout {
  Extent extent;
  int margin = 0;     ///< pixels on every side
  int rows_log2 = 0;  ///< rows of a band; the last one may have less

  [[nodiscard]] int rows() const { return 1 << rows_log2; }
  [[nodiscard]] int count() const { return (extent.height + rows() - 1) >> rows_log2; }
  [[nodiscard]] int stride() const { return extent.width + 2 * margin; }
  [[nodiscard]] std::size_t tile_pixels() const {
    return static_cast<std::size_t>(stride()) * static_cast<std::size_t>(rows() + 2 * margin);
  }
  /// Rows of the image in a band.
  [[nodiscard]] PixelRange rows_of(int band) const {
    return on_screen({band << rows_log2, ((band + 1) << rows_log2) - 1}, extent.height);
  }
  /// Place in the tile of a pixel in row `row` of its band.
  [[nodiscard]] std::size_t in_tile(int x, int row) const {
    return static_cast<std::size_t>(row + margin) * static_cast<std::size_t>(stride()) +
           static_cast<std::size_t>(x + margin);
  }
};

/// For points up to `point_size` pixels wide. @pre 1 <= point_size <= kMaxBinnedSize
[[nodiscard]] BandLayout make_band_layout(Extent extent, int point_size);

}  // namespace rangezip
