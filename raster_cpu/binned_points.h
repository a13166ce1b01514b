#pragma once

#include <span>
#include <vector>

#include "core/raster/draw_item.h"
#include "core/raster/framebuffer.h"
#include "core/raster/row_transform.h"
#include "raster_cpu/band_layout.h"
#include "raster_cpu/fragment.h"
#include "raster_cpu/key_buffer.h"
#include "raster_cpu/point_bins.h"
#include "raster_cpu/simd_kernels.h"
#include "raster_cpu/tile.h"

namespace rangezip {

/// Draws small points in any order at the rate of the second-level cache: they are first sorted by
/// bands of rows, then each band is drawn by itself. The order of drawing cannot show (R9), so
/// threads share neither bins nor bands.
///
/// Memory: 8 bytes a pending point, of which there are at most as many as pixels or as a batch, or
/// 16 where points hang over their bands; and for each thread a tile and 4 KB a band.
class BinnedPoints {
 public:
  /// Begins an image. @param largest size of the points to come, at most kMaxBinnedSize
  void begin(Extent extent, int largest, const DepthBand* depths, const SimdKernels& kernels);

  /// How many points are held at least, however small the image; 2^22 without this.
  void set_batch(std::size_t batch) { batch_ = batch; }

  /// How many points may be added before they must be drawn.
  [[nodiscard]] std::size_t room() const;

  /// Sorts the points begin..end-1 of an item.
  /// @return number rejected by R3 or R4
  /// @pre end - begin <= room()
  std::size_t add(const DrawPoints& points, const RowTransform& rows, std::size_t begin,
                  std::size_t end);

  /// Draws all that was added over `under`, or over nothing where that is empty, and forgets it.
  void draw(std::span<const PixelKey> under, std::span<PixelKey> out);
  void draw(std::span<const PixelKey> under, Framebuffer& out);

 private:
  template <class Store>
  void draw_bands(std::span<const PixelKey> under, const Store& store);
  void forget();

  const SimdKernels* kernels_ = nullptr;
  const DepthBand* depths_ = nullptr;
  BandLayout layout_;
  std::size_t batch_ = kMaxRun;
  std::size_t pending_ = 0;
  std::vector<PointBins> bins_;  ///< one a thread
  std::vector<Tile> tiles_;      ///< one a thread
};

}  // namespace rangezip
