#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/geometry.h"
#include "core/base/progress.h"
#include "core/raster/rasterizer.h"
#include "core/scene/scene.h"

namespace rangezip {

/// For each point of a scene, the direction from which it is mostly seen: an outward direction
/// without normals. Components in 1/127; (0, 0, 0) where no direction sees it.
using VisibilityVotes = std::vector<std::array<std::int8_t, 3>>;

/// Sums, for every point, the directions (of `direction_count` on the sphere) from which it lies
/// within 1.5 pixel sides of the front sheet, and scales the sum to length <= 1.
/// O(direction_count * points).
[[nodiscard]] VisibilityVotes visibility_votes(Rasterizer& rasterizer, const Scene& scene,
                                               double pixel_size, int direction_count = 40,
                                               const Progress& progress = {});

/// What DrawPoints::votes takes: each point's vote along one line of sight, in [-127, 127].
[[nodiscard]] std::vector<std::int8_t> votes_toward(const VisibilityVotes& votes,
                                                    const Vec3& toward_viewer);

}  // namespace rangezip
