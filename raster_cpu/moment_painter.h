#pragma once

#include <span>
#include <vector>

#include "core/raster/rasterizer.h"
#include "raster_cpu/point_bins.h"
#include "raster_cpu/point_moments.h"
#include "raster_cpu/simd_kernels.h"

namespace rangezip {

/// Memory for sums, kept from image to image.
struct MomentMemory {
  std::size_t batch = std::size_t{1} << 22U;  ///< points that are held, at least
  std::vector<std::uint32_t> counts;
  std::vector<SnappedPosition> snapped;
  std::vector<PointBins> bins;  ///< one a thread
};

/// Sums the points around every pixel centre (R13). Private sums per thread would cost 80 bytes a
/// pixel each; instead the threads first sort points by rows of pixels, and then each adds to rows
/// of its own.
class MomentPainter {
 public:
  /// @param kernels null: the scalar code, which is the norm
  MomentPainter(const View& view, const AccumulateWindow& window, const SimdKernels* kernels,
                MomentMemory& memory, Grid<PixelMoments>& out);

  DrawReport draw(std::span<const DrawItem> items);

 private:
  void add_plainly(const DrawPoints& points, const RowTransform& rows);
  void add_binned(const DrawPoints& points, const RowTransform& rows);
  void draw_bins();
  template <class Add>
  void for_each_share_of_rows(const Add& add) const;

  const View& view_;
  const SimdKernels* kernels_;
  MomentMemory& memory_;
  MomentTarget target_;
  std::size_t pending_ = 0;  ///< points in the bins
  DrawReport report_;
};

}  // namespace rangezip
