#pragma once

#include "compare/drawing_judge.h"
#include "core/base/grid.h"
#include "core/io/image_file.h"
#include "core/raster/framebuffer.h"

namespace rangezip::compare {

/// Where two drawings differ and why: white where the reference is empty, grey where it is drawn,
/// darker the farther; differences by their cause: edge blue, depth tie green, depth rounding
/// yellow, depth plane violet, unexplained red.
/// @pre the reference has the extent of causes
[[nodiscard]] Grid<Rgb> draw_differences(const Framebuffer& reference,
                                         const Grid<std::uint8_t>& causes);

}  // namespace rangezip::compare
