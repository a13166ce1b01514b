#pragma once

#include <span>

#include "core/raster/rasterizer.h"
#include "raster_gl/compute_target.h"
#include "raster_gl/compute_tools.h"
#include "raster_gl/compute_triangles.h"

namespace rangezip {

/// Draws scenes by compute kernels (R2-R9, R11, R12).
///
/// With 64-bit atomics a pixel's key is the least of its fragments. Without them there are two
/// passes: the least depth, then the least ID of the fragments with that depth. A large scene is
/// drawn in chunks, the highest IDs first: an ID that an earlier chunk left behind is then greater
/// than all that come and gives way to any of them, as it must where the depth became less, and as
/// R9 says where it stayed.
class ComputePainter {
 public:
  explicit ComputePainter(const ComputeTools& tools);

  /// @param band null: all depths count
  /// @throws BackendError if the device fails
  DrawReport draw(const View& view, std::span<const DrawItem> items, const DepthBand* band,
                  Framebuffer& out);

 private:
  std::size_t draw_points(const DrawPoints& points, const RowTransform& rows, bool is_counting);

  const ComputeTools& tools_;
  ComputeTarget target_;
  ComputeTriangles triangles_;
  SnapRows rows_;
  KernelCounters counters_;
};

}  // namespace rangezip
