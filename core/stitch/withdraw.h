#pragma once

#include <span>

#include "core/patch/patch.h"

namespace rangezip {

/// The patch without the triangles that have a corner within `radius` pixels (in both axes) of one
/// of the places; vertices that are left keep their order. O(patch + pixels of its box).
/// @pre radius >= 0
[[nodiscard]] Patch withdraw_near(const Patch& patch, std::span<const Pixel> places, int radius);

/// The same, around each place with the least of `radius`, 2 `radius`, 4 `radius`, ... that reaches
/// the patch: so it gives way where it has to and nowhere else.
/// @pre radius >= 1
[[nodiscard]] Patch withdraw_locally(const Patch& patch, std::span<const Pixel> places, int radius);

}  // namespace rangezip
