#pragma once

#include <span>

#include "core/base/geometry.h"
#include "core/base/progress.h"
#include "core/scene/scene.h"

namespace rangezip {

/// Whether most points lie near the one before, as in files written along scan lines: of 1024 pairs
/// of neighbours in the order, more than half are closer than 1/64 of the bounding box's diagonal.
/// @pre all positions are finite. O(n).
[[nodiscard]] bool follow_each_other(std::span<const Vec3f> positions);

/// The cloud in order along a curve (order_along_curve()), each point with its number in `cloud`.
/// Drawn in such an order, points fall close to each other in any view, so that the memory they are
/// drawn into is in the cache: a run over 1.4 million points in random order takes a fifth less
/// processor time.
/// @pre all positions are finite, at most 2^32 - 1 of them. O(n); 16 bytes a point beside the
/// result.
/// @throws Cancelled if `progress` says so.
[[nodiscard]] PointCloud ordered_along_curve(const PointCloud& cloud,
                                             const Progress& progress = {});

}  // namespace rangezip
