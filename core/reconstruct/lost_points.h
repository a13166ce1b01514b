#pragma once

#include <span>
#include <vector>

#include "core/base/geometry.h"
#include "core/base/sphere.h"

namespace rangezip {

/// What a re-scan has lost (own): the points that are uncovered after it and were not before, of
/// the places in which over four times as many are as were. In other places lies the wall of a
/// hole, of which any part that is found is a gain. A point of several places is there once for
/// each. O(places * points).
/// @param places that were erased and scanned again
/// @param before, after uncovered ones of the same samples
[[nodiscard]] std::vector<Vec3> lost_points(std::span<const Sphere> places,
                                            std::span<const Vec3> before,
                                            std::span<const Vec3> after);

}  // namespace rangezip
