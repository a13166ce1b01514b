#pragma once

#include <span>

#include "core/raster/framebuffer.h"
#include "core/raster/rasterizer.h"

/// The rules R2-R9 and R11-R13 of docs/rasterization.md a second time, written apart from the
/// rasterizers and as plainly as they can be: exact rational numbers, every pixel asked about
/// every primitive, no boxes, no increments. Slow, for small images.
///
/// Two things are taken from the library: the rows of R1 and the pieces of R8, because the norm
/// says that every backend gets those from shared code. They have tests of their own.
namespace rangezip::oracle {

/// Wrong readings of the rules, to show that a comparison with the oracle would catch them.
struct Mistakes {
  bool other_edges_own_ties = false;     ///< right and upper instead of left and lower (R6)
  bool depth_rounds_to_nearest = false;  ///< instead of down (R7)
  bool quotient_in_float = false;        ///< a rounded quotient instead of the exact one (R4)
  bool halves_go_down = false;           ///< instead of up (R4)
  bool ties_go_to_higher_id = false;     ///< (R9)
  bool points_lean_left = false;         ///< a centre on a border goes to the pixel before it (R5)
  bool denormals_are_zero = false;       ///< as where the processor flushes them (R2)
  bool band_is_open = false;             ///< its ends are left out (R12)
  bool shift_rounds_to_zero = false;     ///< instead of down (R13)
};

[[nodiscard]] Framebuffer render(const View& view, std::span<const DrawItem> items,
                                 const DepthBand* band = nullptr, const Mistakes& mistakes = {});

[[nodiscard]] Grid<PixelMoments> accumulate(const View& view, std::span<const DrawItem> items,
                                            const AccumulateWindow& window,
                                            const Mistakes& mistakes = {});

}  // namespace rangezip::oracle
