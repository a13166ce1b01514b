#pragma once

#include "core/raster/rasterizer.h"

namespace rangezip {

/// A rasterizer that is right by the textbook and rounds on its own, as drivers do: positions in
/// double, snapped to 1/2^bits px; the right and upper edges own their ties; depth in float, to the
/// nearest of 2^24 - 1 steps; of equal depths the first drawn stays. Every pixel of a box is asked:
/// for small images. Cuts nothing: for scenes before the eye and without clip planes. Draws only.
class TextbookRasterizer final : public Rasterizer {
 public:
  explicit TextbookRasterizer(int subpixel_bits) : subpixel_bits_(subpixel_bits) {}
  [[nodiscard]] RasterizerInfo info() const override;

 private:
  DrawReport do_render(const View& view, std::span<const DrawItem> items,
                       Framebuffer& out) override;
  DrawReport do_render_in_band(const View& view, std::span<const DrawItem> items,
                               const DepthBand& band, Framebuffer& out) override;
  DrawReport do_accumulate(const View& view, std::span<const DrawItem> items,
                           const AccumulateWindow& window, Grid<PixelMoments>& out) override;

  int subpixel_bits_;
};

}  // namespace rangezip
