#pragma once

#include <span>
#include <vector>

#include "core/raster/rasterizer.h"
#include "raster_cpu/binned_points.h"
#include "raster_cpu/key_buffer.h"
#include "raster_cpu/simd_kernels.h"

namespace rangezip {

/// The image of one part of a scene, with kKeyPadding behind it. It is left empty by whoever reads
/// it last: emptying what is in the cache costs less than to clear it before the next image.
struct KeyLayer {
  std::vector<PixelKey> keys;
  bool is_empty = true;
};

/// Memory for drawing, kept from image to image.
struct PainterMemory {
  std::vector<KeyLayer> layers;
  std::vector<SnappedPosition> snapped;
  BinnedPoints binned;
};

/// Draws scenes (R2-R9, R11, R12). Two ways to a pixel, which give the same bits: straight into an
/// image of keys, of which each thread has its own, for triangles, large points, and points that
/// follow each other; and, with vector instructions, through bins for small points in any order.
class ScenePainter {
 public:
  /// @param depths null: all count
  /// @param kernels null: the scalar code, which is the norm
  ScenePainter(const View& view, const DepthBand* depths, const SimdKernels* kernels,
               PainterMemory& memory);

  DrawReport draw(std::span<const DrawItem> items, Framebuffer& out);

 private:
  struct Step;

  [[nodiscard]] std::vector<Step> plan(std::span<const DrawItem> items) const;
  void begin_layers(std::size_t count);
  [[nodiscard]] std::span<const PixelKey> merge_layers();
  void unpack_layers(Framebuffer& out);
  void end_layers(std::size_t first);
  void draw_layered(const Step& step);
  void draw_points(const DrawPoints& points, const RowTransform& rows);
  void draw_triangles(const DrawTriangles& item, const RowTransform& rows);
  void bin_points(const DrawPoints& points, const RowTransform& rows);
  void flush_bins();
  template <class Draw>
  std::size_t draw_parts(std::size_t count, const Draw& draw);

  const View& view_;
  const DepthBand* depths_;
  const SimdKernels* kernels_;
  PainterMemory& memory_;
  std::size_t layers_ = 0;  ///< that are in use
  DrawReport report_;
};

}  // namespace rangezip
