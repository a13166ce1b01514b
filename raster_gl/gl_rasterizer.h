#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "core/raster/rasterizer.h"
#include "raster_gl/gl_context.h"

namespace rangezip {

struct GlOptions {
  /// Bytes of one buffer that a shader may see; larger scenes and images are drawn in parts.
  /// 0: what the driver allows.
  std::size_t block_bytes = 0;
  /// Bytes of uploads that are kept for items with a content key.
  std::size_t cache_bytes = std::size_t{1} << 30;
  /// R2 in double precision, also where floats do it right: for tests.
  bool wide_rows = false;
};

/// Draws with OpenGL 4.5 the bits of docs/rasterization.md, hence those of CpuRasterizer. The
/// context is current during a call only; calls may come from any thread, one at a time. Must end
/// before the process does: no static object, for Mesa takes its contexts down at exit.
class GlRasterizer final : public Rasterizer {
 public:
  /// @throws BackendError if the context lacks what is needed (docs/determinism.md), or if a test
  ///     drawing breaks a rule; the text names it.
  explicit GlRasterizer(std::unique_ptr<GlContext> context, const GlOptions& options = {});
  ~GlRasterizer() override;

  [[nodiscard]] RasterizerInfo info() const override;

  /// Uploads of positions and corners so far: what is kept is not uploaded again.
  [[nodiscard]] std::size_t uploads() const;

 private:
  DrawReport do_render(const View& view, std::span<const DrawItem> items,
                       Framebuffer& out) override;
  DrawReport do_render_in_band(const View& view, std::span<const DrawItem> items,
                               const DepthBand& band, Framebuffer& out) override;
  DrawReport do_accumulate(const View& view, std::span<const DrawItem> items,
                           const AccumulateWindow& window, Grid<PixelMoments>& out) override;

  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace rangezip
