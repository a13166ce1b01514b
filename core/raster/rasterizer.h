#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "core/base/grid.h"
#include "core/raster/draw_item.h"
#include "core/raster/framebuffer.h"
#include "core/view/view.h"

namespace rangezip {

/// What a caller may rely on.
struct RasterizerInfo {
  std::string name;           ///< "cpu", "gl: llvmpipe (LLVM 15.0.6, 256 bits)"
  Extent max_extent;          ///< largest framebuffer
  int max_point_size = 1;     ///< pixels
  int subpixel_bits = 8;      ///< bits to which corners are snapped
  bool reproducible = false;  ///< same bits on every machine, compiler and thread count
};

/// Limits that every exact backend shares.
inline constexpr int kMaxRasterExtent = 8192;
inline constexpr int kMaxPointSize = 255;

/// What was left out of a drawing, for the report; the sum over all items.
struct DrawReport {
  std::size_t dropped_points = 0;     ///< not finite, or outside the guard range (R3, R4)
  std::size_t dropped_triangles = 0;  ///< with a corner that is NaN or Inf (R8)
};

/// Draws points and triangles into a depth and an ID buffer.
///
/// The one seam between the pipeline and the hardware. It is cut where the algorithm cuts (one
/// view in, nearest primitives out), not where OpenGL cuts (buffers, shaders, state): a new
/// backend writes the three operations and info(), and nothing else.
///
/// The public functions are not virtual: they check the arguments once for every backend, then
/// call do_*(). The rules of drawing are in docs/rasterization.md (R1-R13); CpuRasterizer is
/// their reference, and every other exact backend gives the same bits.
///
/// All throw InvalidArgument if a corner index or a point size is out of range, the extent
/// exceeds max_extent, votes are given for another number of points, a grid has another extent
/// than the view, or the id ranges of the items overlap, descend, or reach kNoPrimitive.
/// (Ascending ids make "the first drawn wins a tie", OpenGL's rule, and "the lower id wins", the
/// reference's rule, the same rule.) All throw BackendError if the device fails; what is written
/// is then unspecified.
class Rasterizer {
 public:
  virtual ~Rasterizer() = default;
  Rasterizer(const Rasterizer&) = delete;
  Rasterizer& operator=(const Rasterizer&) = delete;

  [[nodiscard]] virtual RasterizerInfo info() const = 0;

  /// Clears `out` to the view's extent, keeping its memory where it can, and draws `items`.
  DrawReport render(const View& view, std::span<const DrawItem> items, Framebuffer& out);
  /// The same, into a framebuffer of its own.
  [[nodiscard]] Framebuffer render(const View& view, std::span<const DrawItem> items);

  /// render(), but a fragment counts only where band.lower <= depth <= band.upper (R12).
  DrawReport render_in_band(const View& view, std::span<const DrawItem> items,
                            const DepthBand& band, Framebuffer& out);

  /// Sums the points of `items` (triangles are ignored; point_size does not matter) around every
  /// pixel centre (R13). @throws Error if a pixel takes more than 2^19 points.
  DrawReport accumulate(const View& view, std::span<const DrawItem> items,
                        const AccumulateWindow& window, Grid<PixelMoments>& out);

 protected:
  Rasterizer() = default;

 private:
  virtual DrawReport do_render(const View& view, std::span<const DrawItem> items,
                               Framebuffer& out) = 0;
  virtual DrawReport do_render_in_band(const View& view, std::span<const DrawItem> items,
                                       const DepthBand& band, Framebuffer& out) = 0;
  virtual DrawReport do_accumulate(const View& view, std::span<const DrawItem> items,
                                   const AccumulateWindow& window, Grid<PixelMoments>& out) = 0;
};

}  // namespace rangezip
