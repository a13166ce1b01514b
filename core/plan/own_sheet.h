#pragma once

#include <span>

#include "core/base/geometry.h"

namespace rangezip {

/// The sum of the outer products of some places, about their mean. @pre not empty
[[nodiscard]] Mat3 scatter_of(std::span<const Vec3> places);

/// RMS distance of places from their best plane, in an unbiased estimate (the plane takes up three
/// degrees of freedom), without those on the other side of a wall: past a gap along the normal that
/// is at least `wall` wide, and four times as wide as the spread on either side of it; 0 where that
/// says nothing. O(n log n).
/// @param places around the origin, as offsets from the place that is asked about, which is the
///     first of them; the next few are the nearest ones
/// @param wall model units: no thinner ones are told
[[nodiscard]] double distance_from_plane(std::span<const Vec3> places, double wall);

}  // namespace rangezip
