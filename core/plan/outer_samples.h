#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/geometry.h"
#include "core/base/progress.h"
#include "core/scene/scene.h"

namespace rangezip {

/// Flags (1) of samples of a scene's triangles that have, on one side of the triangle, the outside
/// of all bodies: the walls of a groove or cavity, but not what of one body lies within another,
/// where two touch, nor the walls of a closed void: pieces that look inwards where the others look
/// outwards. Lines along the three axes tell: how many bodies a place is inside of is the sum of
/// the triangles above it, those that look up less those that look down (the winding number). A
/// line along which that sum is not 0 as a whole, as beside a sheet that is open or whose triangles
/// look in different directions, tells nothing, nor does one that only grazes the sample's
/// triangle; without any that does, or where they disagree, the flag is 0.
/// @param samples world coordinates, on triangles of the scene (area_samples())
/// Cost: O(n log n) in the triangles to join and sort them into cells, and per sample those in its
/// cell; samples in parallel.
[[nodiscard]] std::vector<std::uint8_t> outer_samples(const Scene& scene,
                                                      std::span<const Vec3> samples,
                                                      const Progress& progress = {});

/// Whether hardly any (1 %) of the samples are not outer: then the scene's bodies stand apart, and
/// what of them is hard to see is the ground of grooves and cavities.
[[nodiscard]] bool are_outer(const std::vector<std::uint8_t>& is_outer);

}  // namespace rangezip
