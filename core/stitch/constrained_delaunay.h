#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/geometry.h"
#include "core/stitch/predicates.h"

namespace rangezip {

struct ConstrainedDelaunay {
  std::vector<Triangle> triangles;   ///< counter-clockwise; empty if all points are collinear
  std::size_t skipped_segments = 0;  ///< that would have crossed one entered before
};

/// The constrained Delaunay triangulation of the convex hull of `points`: every segment is an edge
/// of it (or a chain of edges, where it runs over other points), and no circle around a triangle
/// contains a point that the triangle's corners can see past the segments. Exact; the same input
/// gives the same triangles in the same order.
///
/// Points are inserted along a Hilbert curve, each found by a walk from the one before, with
/// Lawson's flips; the outside is triangulated by one vertex at infinity, so no coordinate is
/// made up. Segments are entered afterwards by flipping the edges they cross [Sloan 1993].
/// Of segments that cross, the first one is kept. Segments between equal or collinear points
/// change nothing.
///
/// Cost: O(n log n) and about 1 us a point on point sets as boundaries make them.
/// @pre points are distinct and within kGridLimit; segments index them
[[nodiscard]] ConstrainedDelaunay triangulate_constrained(
    std::span<const GridPoint> points, std::span<const std::array<std::uint32_t, 2>> segments);

}  // namespace rangezip
