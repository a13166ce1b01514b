#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// Marks (1) the `points` that have a face of `mesh` within `distance` (model units). Exact
/// distances; candidates come from a uniform grid over the faces.
/// O(faces + points) for faces whose size is comparable to `distance`; memory about 20 bytes a
/// face plus the grid. @throws InvalidArgument if distance is not positive and finite.
[[nodiscard]] std::vector<std::uint8_t> covered_points(std::span<const Vec3> points,
                                                       const TriangleMesh& mesh, double distance);

/// Share of `points` that have a face of `mesh` within `distance` (model units), in [0, 1]; 1 for
/// no points. Cost and errors as those of covered_points().
[[nodiscard]] double coverage_of(std::span<const Vec3> points, const TriangleMesh& mesh,
                                 double distance);

}  // namespace rangezip
