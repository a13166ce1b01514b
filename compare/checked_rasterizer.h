#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "core/base/grid.h"
#include "core/raster/rasterizer.h"

namespace rangezip::compare {

/// The first drawing in which two rasterizers differed.
struct DrawingDifference {
  std::size_t number = 0;      ///< of the drawing, from 0
  std::string operation;       ///< "render", "render_in_band", "accumulate"
  std::size_t pixels = 0;      ///< that differ; 0 if only the report of what was dropped does
  std::optional<Pixel> first;  ///< bottom row first
};

struct DrawingsRecord {
  std::size_t drawings = 0;
  std::size_t different = 0;
  std::optional<DrawingDifference> first;
};

/// Makes every drawing twice, by a candidate and by the reference, compares the two bit for bit,
/// and hands on the candidate's. Both get the same arguments, so a difference is the rasterizer's
/// own, whatever came before.
class CheckedRasterizer final : public Rasterizer {
 public:
  /// Both must outlive this object.
  CheckedRasterizer(Rasterizer& reference, Rasterizer& candidate)
      : reference_(reference), candidate_(candidate) {}

  [[nodiscard]] RasterizerInfo info() const override { return candidate_.info(); }
  /// Of the drawings since the last call.
  [[nodiscard]] DrawingsRecord take_record();

 private:
  DrawReport do_render(const View& view, std::span<const DrawItem> items,
                       Framebuffer& out) override;
  DrawReport do_render_in_band(const View& view, std::span<const DrawItem> items,
                               const DepthBand& band, Framebuffer& out) override;
  DrawReport do_accumulate(const View& view, std::span<const DrawItem> items,
                           const AccumulateWindow& window, Grid<PixelMoments>& out) override;
  void record(DrawingDifference difference, bool same_report);

  Rasterizer& reference_;
  Rasterizer& candidate_;
  DrawingsRecord record_;
};

}  // namespace rangezip::compare
