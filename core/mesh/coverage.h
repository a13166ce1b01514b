#pragma once

#include <span>

#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// Share of `points` that have a face of `mesh` within `distance` (model units), in [0, 1]; 1 for
/// no points. Exact distances; candidates come from a uniform grid over the faces.
/// O(faces + points) for faces whose size is comparable to `distance`; memory about 20 bytes a
/// face plus the grid. @throws InvalidArgument if distance is not positive and finite.
[[nodiscard]] double coverage_of(std::span<const Vec3> points, const TriangleMesh& mesh,
                                 double distance);

}  // namespace rangezip
