#pragma once

#include <cstddef>
#include <span>

#include "core/base/geometry.h"
#include "core/finish/point_grid.h"

namespace rangezip {

/// The flat disc that a closed polygon spans.
struct LoopDisc {
  Vec3 middle{0.0};     ///< of the line, not of its corners, which may be dense on one side
  Vec3 axis{0.0};       ///< unit, counter-clockwise around it; 0 if the polygon encloses nothing
  double radius = 0.0;  ///< of a circle with the area that the polygon encloses, model units
};

/// @param points of the polygon, in order; two at least. O(points).
[[nodiscard]] LoopDisc disc_of_loop(std::span<const Vec3> points);

/// Unit, from a place straight to the axis of a disc.
[[nodiscard]] Vec3 toward_axis(const LoopDisc& disc, const Vec3& place);

/// How many points lie in the middle half of a disc: how far from its axis, since a polygon around
/// a hole may wind along the wall, and up to as far along it.
[[nodiscard]] std::size_t points_in_middle(const PointGrid& cloud, const LoopDisc& disc);

/// Whether points lie in the middle of a polygon, at least a quarter as densely as around its
/// corners: it does not lead around a limb, or a hole. O(corners) and the points near them.
/// @param disc that of the polygon
[[nodiscard]] bool is_filled(const PointGrid& cloud, std::span<const Vec3> polygon,
                             const LoopDisc& disc);

}  // namespace rangezip
