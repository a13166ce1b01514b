#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/base/geometry.h"

namespace rangezip {

/// The faces that fill a hole, with indices of their own: first the points of the loop in filling
/// order, then points inside.
struct FillPatch {
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
  std::size_t loop_size = 0;
};

/// Adds points inside a patch until its triangles are about as large as the edges around it: splits
/// faces at their centre and turns edges until they are locally Delaunay [Liepa 2003, 4].
/// @param scale per point of the loop: the edge length wanted there, model units
/// @param is_forbidden whether the edge between two points of the loop exists outside of the patch
void refine_patch(FillPatch& patch, std::vector<double> scale,
                  const std::function<bool(std::uint32_t, std::uint32_t)>& is_forbidden);

/// What lies beside the loop: for each of its points the neighbours outside the patch, the two
/// along the loop included.
struct LoopSurroundings {
  std::vector<Vec3> neighbor_sum;
  std::vector<int> neighbor_count;
};

/// Moves the inner points to where each is the mean of its neighbours (a soap film): flat.
void flatten_patch(FillPatch& patch);

/// Moves the inner points so that the surface continues that around the hole: the umbrella of the
/// umbrella vanishes [Kobbelt et al. 1998, 3]. Solved directly, O(n^3) for n inner points;
/// patches with more than 400 are left as they are. @return whether it was done
bool fair_patch(FillPatch& patch, const LoopSurroundings& surroundings);

}  // namespace rangezip
