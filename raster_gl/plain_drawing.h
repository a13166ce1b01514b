#pragma once

#include <span>

#include "core/raster/framebuffer.h"
#include "core/raster/rasterizer.h"

/// The rules in their plainest form, for the small scenes of the self-test: every pixel is asked
/// about every primitive. Positions come from the core (snap_positions(), split_triangle()).
namespace rangezip::plain {

/// R5-R9, R11, R12. @param band null: all depths count
/// @pre numerators of R7 fit in 64 bits: as where corners lie within 1000 pixels of the image
[[nodiscard]] Framebuffer draw(const View& view, std::span<const DrawItem> items,
                               const DepthBand* band);

/// R13.
[[nodiscard]] Grid<PixelMoments> sum(const View& view, std::span<const DrawItem> items,
                                     const AccumulateWindow& window);

}  // namespace rangezip::plain
