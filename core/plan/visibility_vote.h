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

/// More would not fit the sums, nor tell more.
inline constexpr int kMaxVoteDirections = 1000;

/// Sums, for every point, the directions (of `direction_count` on the sphere) from which it lies
/// within 1.5 pixel sides of the front sheet, and scales the sum so that a point of an open plane
/// gets a vote of full length; less is a point that few directions see. Polygons of the scene
/// hide points. Empty for a scene without points. O(direction_count * points).
/// @param pixel_size of the images that decide; about that of the scans. Made coarser where the
///     scene would be more than 2048 pixels across.
/// @throws InvalidArgument if pixel_size is not positive and finite or direction_count lies outside
///     [1, kMaxVoteDirections].
[[nodiscard]] VisibilityVotes visibility_votes(Rasterizer& rasterizer, const Scene& scene,
                                               double pixel_size, int direction_count = 40,
                                               const Progress& progress = {});

/// What DrawPoints::votes takes: each point's vote along one line of sight, in [-127, 127].
/// @throws InvalidArgument if the direction is zero or not finite.
[[nodiscard]] std::vector<std::int8_t> votes_toward(const VisibilityVotes& votes,
                                                    const Vec3& toward_viewer);

}  // namespace rangezip
