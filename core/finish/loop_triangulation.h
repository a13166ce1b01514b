#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "core/base/geometry.h"
#include "core/finish/boundary_loops.h"
#include "core/finish/cloud_evidence.h"
#include "core/finish/corner_table.h"

namespace rangezip {

/// A closed polygon in space that is to be triangulated.
struct LoopShape {
  std::vector<Vec3> points;        ///< edge i runs from point i to point i + 1, the last one back
  std::vector<Vec3> edge_normals;  ///< unit normal of the face across edge i, or zero: none
  /// Pairs of points between which no edge is to be made (there is one already), both ways, in
  /// ascending order.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> forbidden;
  /// No longer edge is made, model units.
  double longest_edge = std::numeric_limits<double>::infinity();
  AirTest is_in_air;       ///< empty: nothing is known
  double long_side = 0.0;  ///< shorter sides, model units, do not lead through air
  std::function<bool(const Triangle&)> can_take;  ///< of points; empty: any triangle may be made
  bool by_length = false;  ///< angles do not count: between the sides of a crack they tell nothing

  [[nodiscard]] bool is_too_long(std::uint32_t i, std::uint32_t k) const {
    return glm::length(points[k] - points[i]) > longest_edge;
  }
  [[nodiscard]] bool is_forbidden(std::uint32_t i, std::uint32_t k) const {
    return is_too_long(i, k) ||
           std::binary_search(forbidden.begin(), forbidden.end(), std::pair{i, k});
  }
};

/// The shape of a mesh's boundary loop: point i is vertices_of(loop, table)[i], and no edge that
/// the mesh has may be made again.
/// @param evidence points to air: sides over 1.5 h are doubted
[[nodiscard]] LoopShape shape_of(const BoundaryLoop& loop, const CornerTable& table,
                                 const std::vector<Vec3>& positions,
                                 const CloudEvidence& evidence = {});

/// Triangulates a loop without new points so that the largest angle between neighbouring faces,
/// those across the loop included, is least, and among equals the area [Barequet, Sharir 1995;
/// Liepa 2003]; if asked for, so that the length of all sides is. If much of that leads through
/// air, and others with half as much or less, it is one of those with the least: a crack along the
/// wall of a tube is closed along the wall, not across the tube. Loops beyond 100 edges are first
/// divided by short chords, rather not through air; if what that gives leads through air, three
/// others are tried instead of the first chord, since the shortest one may part the two rims of a
/// crack around a tube. Triangles hold indices of points and run along the loop's edges. Empty if
/// the forbidden edges, and triangles that can not be taken, leave no triangulation, or for fewer
/// than three points. Cost: O(n^3) up to 100 edges, O(n^2) to divide longer ones; up to four times
/// that beside air.
[[nodiscard]] std::vector<Triangle> triangulate_loop(const LoopShape& shape);

/// How much of a triangulation leads through air, as a share of its area; 0 if nothing is known.
[[nodiscard]] double share_in_air(const LoopShape& shape, const std::vector<Triangle>& triangles);

}  // namespace rangezip
