#pragma once

#include "core/raster/rasterizer.h"

namespace rangezip {

/// The reference: docs/rasterization.md in code, the same bits everywhere. Uses the threads of the
/// enclosing run_with_threads(); the image never depends on their number.
class CpuRasterizer final : public Rasterizer {
 public:
  CpuRasterizer() = default;

  [[nodiscard]] RasterizerInfo info() const override;

 private:
  DrawReport do_render(const View& view, std::span<const DrawItem> items,
                       Framebuffer& out) override;
  DrawReport do_render_in_band(const View& view, std::span<const DrawItem> items,
                               const DepthBand& band, Framebuffer& out) override;
  DrawReport do_accumulate(const View& view, std::span<const DrawItem> items,
                           const AccumulateWindow& window, Grid<PixelMoments>& out) override;
};

}  // namespace rangezip
