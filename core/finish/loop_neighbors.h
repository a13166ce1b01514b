#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/finish/boundary_loops.h"
#include "core/finish/corner_table.h"

namespace rangezip {

/// A vertex of one boundary loop and the nearest one of another loop.
struct LoopNeighbors {
  std::uint32_t loop_a, loop_b;    ///< a < b
  double distance;                 ///< model units
  std::uint32_t place_a, place_b;  ///< in vertices_of() the loops

  friend bool operator<(const LoopNeighbors& p, const LoopNeighbors& q) {
    if (p.loop_a != q.loop_a) return p.loop_a < q.loop_a;
    if (p.loop_b != q.loop_b) return p.loop_b < q.loop_b;
    if (p.distance != q.distance) return p.distance < q.distance;
    if (p.place_a != q.place_a) return p.place_a < q.place_a;
    return p.place_b < q.place_b;
  }
};

/// For each vertex of each loop the nearest vertex of every other loop within `reach`, sorted: by
/// pair of loops, the nearest first. O(n log n) in the vertices of all loops, and for each of them
/// those up to twice the reach away along every axis.
/// @param reach model units, positive
/// @param are_wanted whether two loops are to be compared; called with loop indices
[[nodiscard]] std::vector<LoopNeighbors> loop_neighbors(
    std::span<const BoundaryLoop> loops, const CornerTable& table,
    const std::vector<Vec3>& positions, double reach,
    const std::function<bool(std::uint32_t a, std::uint32_t b)>& are_wanted);

/// The parts that each belong to one pair of loops which run beside each other: at least four
/// neighbours, and half as many as the shorter loop has vertices.
[[nodiscard]] std::vector<std::span<const LoopNeighbors>> loops_side_by_side(
    std::span<const LoopNeighbors> neighbors, std::span<const BoundaryLoop> loops);

/// The runs in which two loops are beside each other for a part of their length: at least sixteen
/// neighbours whose places in the first loop lie within four of the next one's, in the order of
/// that loop. None of loops that are so all around.
[[nodiscard]] std::vector<std::vector<LoopNeighbors>> parts_side_by_side(
    std::span<const LoopNeighbors> neighbors, std::span<const BoundaryLoop> loops);

}  // namespace rangezip
