#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/patch/patch.h"

namespace rangezip {

/// The patch without the grid triangles that have a corner within `radius` pixels (in both axes) of
/// one of the places. Vertices that are left keep their order and their source. An unchanged patch
/// is returned as it is. O(pixels).
/// @param image that the patch was made of
/// @param patch not decimated: its new boundary has the full resolution, as the stitch wants it
/// @pre radius >= 0
[[nodiscard]] Patch withdraw_near(const RangeImage& image, const Patch& patch,
                                  std::span<const Pixel> places, int radius);

/// Twice the radius; of 0, 1.
[[nodiscard]] constexpr int wider(int radius) {
  return radius > 0 ? 2 * radius : 1;
}

/// The same, around each place with the first of `radius`, wider(`radius`), ... that reaches the
/// patch: so it gives way where it has to and nowhere else.
/// @pre radius >= 0
[[nodiscard]] Patch withdraw_locally(const RangeImage& image, const Patch& patch,
                                     std::span<const Pixel> places, int radius);

inline constexpr std::uint32_t kNotInPatch = 0xffff'ffffU;

/// For each of `pixels` the vertex of the patch there, or kNotInPatch. Linear.
/// @param pixels in the order of the grid's rows, as those of a patch are
[[nodiscard]] std::vector<std::uint32_t> numbers_in(const Patch& patch,
                                                    std::span<const Pixel> pixels);

}  // namespace rangezip
