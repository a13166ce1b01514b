#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/base/progress.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

struct UntangleReport {
  std::size_t crossed = 0;                                    ///< pairs of faces at first
  std::vector<std::pair<std::uint32_t, std::uint32_t>> left;  ///< pairs that still cross
};

/// Takes vertices back to where they were `before`, of faces that cross others now: at first those
/// of these faces, in later rounds those around them, too. Nothing crosses in the end if nothing
/// did before, unless six rounds do not do. Cost: self_intersections() a round.
/// @param before a position for each vertex
/// @throws Cancelled if `progress` says so.
UntangleReport take_back_crossing(TriangleMesh& mesh, const std::vector<Vec3>& before,
                                  const Progress& progress = {});

/// Pulls faces apart that cross others by smoothing where they are: the inner vertices of crossing
/// faces move to the middle of their neighbours, from the third round on with those around them.
/// Most folds that moving vertices by themselves has made come apart so, without a hole to fill.
/// Ends when nothing crosses, or after six rounds. The topology and the boundary stay. Cost:
/// self_intersections() of what has changed a round.
/// @param changed faces; all others are known not to cross each other
/// @throws Cancelled if `progress` says so.
/// @pre oriented, manifold (core/finish/clean_topology.h)
UntangleReport untangle(TriangleMesh& mesh, std::span<const std::uint32_t> changed,
                        const Progress& progress = {});

}  // namespace rangezip
