#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/base/geometry.h"

namespace rangezip {

/// Points that lie together.
struct Place {
  Vec3 center{0.0};     ///< mean of the points
  double radius = 0.0;  ///< to the farthest of them, model units
  std::size_t points = 0;
  double area = 0.0;  ///< that they stand for, square model units
};

/// Sorts points into places: two belong together if a chain of steps up to `reach` in each axis
/// joins them; a step up to twice that may do so as well. Most points first. O(points log points).
/// @param areas what each point stands for; as many as points
/// @throws InvalidArgument if reach is not positive and finite, or the spans differ in length.
[[nodiscard]] std::vector<Place> places_of(std::span<const Vec3> points,
                                           std::span<const double> areas, double reach);

}  // namespace rangezip
