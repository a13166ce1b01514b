#pragma once

#include <span>

#include "core/base/geometry.h"

namespace rangezip {

/// A place of a cloud, and how far its nearest points reach.
struct LinePlace {
  Vec3 center{0.0};
  double radius_of_4 = 0.0;   ///< to the fourth nearest point, model units
  double radius_of_16 = 0.0;  ///< to the sixteenth; 0: there are fewer
};

/// The gap between scan lines, model units, of a cloud whose points lie far closer along lines than
/// the lines do to each other, as laser scanners leave them: so many points a surface has there, so
/// large are the holes between them. Lines of several scans may cross each other, and leave wider
/// gaps where only one of them has seen the surface; what four fifths of the places do not exceed
/// is given. 0 for a cloud that is spread evenly, at random or in a grid, or whose gaps are less
/// than about seven times the step along a line: there the number of points tells enough.
///
/// A disc has four times the points of one half as wide, a piece of a line only twice as many:
/// whether the cloud may be made of lines is told by the radii. Only then the holes are measured:
/// by how far locations spread over the tangent plane around a place, but not beyond a border, are
/// from the nearest point. On lines a gap g apart that is g / sqrt(12) as root mean square; among
/// points at random, d of them a unit area, 1 / sqrt(pi d).
/// Cost: none where the radii tell that there are no lines, else O(points), 50 ns each.
[[nodiscard]] double line_gap(std::span<const Vec3> points, std::span<const LinePlace> places);

}  // namespace rangezip
