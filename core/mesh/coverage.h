#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// For each of `points` whether a face of `mesh` lies within `distance` (model units). Exact
/// distances; candidates come from a uniform grid over the faces.
/// O(faces + points) for faces whose size is comparable to `distance`; memory about 20 bytes a
/// face plus the grid. @throws InvalidArgument if distance is not positive and finite.
[[nodiscard]] std::vector<std::uint8_t> covered_points(std::span<const Vec3> points,
                                                       const TriangleMesh& mesh, double distance);

/// Those of `points`, in their order, that no face of `mesh` lies within `distance` of.
[[nodiscard]] std::vector<Vec3> points_off(std::span<const Vec3> points, const TriangleMesh& mesh,
                                           double distance);

}  // namespace rangezip
