#pragma once

#include <map>
#include <span>
#include <utility>

#include "core/raster/rasterizer.h"
#include "raster_gl/compute_painter.h"
#include "raster_gl/compute_tools.h"
#include "raster_gl/hardware_target.h"

namespace rangezip {

/// Draws scenes by OpenGL's fixed functions, exactly (R2-R9, R11, R12). A kernel snaps positions;
/// what is left to the driver is which pixels a triangle covers, and the depth test. The viewport
/// is larger than the image, so that nothing near it is clipped; triangles that reach beyond the
/// viewport, and the pieces of those that are cut, are drawn by kernels and put together with the
/// rest.
class FixedPainter {
 public:
  /// @throws BackendError if the driver's limits do not allow it
  explicit FixedPainter(const ComputeTools& tools);

  /// @param band null: all depths count
  /// @throws BackendError if the device fails
  DrawReport draw(const View& view, std::span<const DrawItem> items, const DepthBand* band,
                  Framebuffer& out);

 private:
  std::size_t draw_points(const DrawPoints& points, bool is_counting);
  bool draw_triangles(const DrawTriangles& item);
  bool snap_corners(std::span<const Vec3f> positions, std::uint64_t content_key);
  void draw_chunk(const DrawTriangles& item, const GlBuffer& corners, std::size_t begin,
                  std::size_t count);
  const GlProgram& program(bool of_points);

  const ComputeTools& tools_;
  HardwareTarget target_;
  ComputeTools outside_tools_;
  ComputePainter outside_;
  SnapRows rows_;
  KernelCounters counters_;
  GlBuffer snapped_;
  bool has_band_ = false;
  std::map<std::pair<bool, bool>, GlProgram> programs_;  ///< of points or triangles, with a band
};

}  // namespace rangezip
