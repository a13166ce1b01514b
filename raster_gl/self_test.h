#pragma once

#include <optional>
#include <string>

#include "core/raster/rasterizer.h"

namespace rangezip {

/// Draws small scenes in which single rules of docs/rasterization.md decide the pixels: numbers
/// that must not be fused, flushed or divided sloppily, points of every kind of size, edges through
/// pixel centres, equal depths, bands, sums that carry. Some milliseconds.
/// @return the first rule that the rasterizer breaks, such as "R6, edges through pixel centres:
///     3 of 4096 pixels differ"; none if it keeps all
[[nodiscard]] std::optional<std::string> find_broken_rule(Rasterizer& rasterizer);

}  // namespace rangezip
