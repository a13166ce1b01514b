#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/patch/patch.h"

namespace rangezip {

/// The patch without the grid triangles that have a corner within `radius` pixels (in both axes) of
/// one of the places. Vertices that are left keep their order and their source; of a decimated
/// patch the rest has the full resolution again, so that its new boundary has, and vertices that it
/// did not have are of unknown source. An unchanged patch is returned as it is. O(pixels).
/// @param image that the patch was made of
/// @pre radius >= 0
[[nodiscard]] Patch withdraw_near(const RangeImage& image, const Patch& patch,
                                  std::span<const Pixel> places, int radius);

/// The same, around each place with the least of `radius`, 2 `radius`, 4 `radius`, ... that reaches
/// the patch: so it gives way where it has to and nowhere else.
/// @pre radius >= 1
[[nodiscard]] Patch withdraw_locally(const RangeImage& image, const Patch& patch,
                                     std::span<const Pixel> places, int radius);

inline constexpr std::uint32_t kNotInPatch = 0xffff'ffffU;

/// For each of `pixels` the vertex of the patch there, or kNotInPatch. Linear.
/// @param pixels in the order of the grid's rows, as those of a patch are
[[nodiscard]] std::vector<std::uint32_t> numbers_in(const Patch& patch,
                                                    std::span<const Pixel> pixels);

}  // namespace rangezip
