#pragma once

#include <span>

#include "core/raster/rasterizer.h"
#include "raster_gl/compute_tools.h"
#include "raster_gl/image_part.h"

namespace rangezip {

/// Sums points around every pixel centre by a kernel (R13). Without 64-bit atomics a sum is two
/// 32-bit atomics with a carry: the order of additions does not matter to either.
class ComputeMoments {
 public:
  explicit ComputeMoments(const ComputeTools& tools);

  /// @throws Error if a pixel takes more than 2^19 points; BackendError if the device fails
  DrawReport add(const View& view, std::span<const DrawItem> items, const AccumulateWindow& window,
                 Grid<PixelMoments>& out);

 private:
  void begin(const ImagePart& part, const AccumulateWindow& window);
  void add_points(const DrawPoints& points, const ImagePart& part, int shift, bool is_counting);
  void check_counts(const ImagePart& part) const;

  const ComputeTools& tools_;
  SnapRows rows_;
  KernelCounters counters_;
  GlBuffer votes_;
  GlBuffer lower_;
  GlBuffer upper_;
  GlBuffer reference_;
  GlBuffer sums_;
  GlBuffer counts_;
};

}  // namespace rangezip
