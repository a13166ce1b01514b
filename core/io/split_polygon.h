#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/geometry.h"
#include "core/base/progress.h"

namespace rangezip {

/// Cuts a polygon into triangles of the same orientation: a fan if it is convex, else ear by ear
/// in the plane that fits it best. Triangles with two corners at the same position are left out.
/// The ear taken is always the first one from the corner before the last ear on. O(n) if convex;
/// else about O(n log n), more where many corners lie in many triangles of three others in a row,
/// or where the outline crosses itself.
/// @param polygon corners, as indices of `positions`
/// @param positions finite, one per corner, in the order of `polygon`
/// @param triangles the pieces are appended to it
/// @throws Cancelled if `progress` says so.
void split_polygon(std::span<const std::uint32_t> polygon, std::span<const Vec3> positions,
                   std::vector<Triangle>& triangles, const Progress& progress = {});

}  // namespace rangezip
