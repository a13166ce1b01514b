#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/geometry.h"
#include "core/base/progress.h"
#include "core/raster/rasterizer.h"
#include "core/scene/scene.h"

namespace rangezip {

/// Flags (1) of samples of a scene's surface that are seen from none of 40 directions all around:
/// something is drawn in front of them by more than a quarter of a pixel side, or of the sides of
/// the images that tell if these are longer: four times as fine as the scans, but no more than 2048
/// pixels across. What polygons have inside is unseen, and the ground of deep pockets.
/// Cost: an image a direction, until all are seen.
/// @param samples world coordinates
/// @param pixel_size of the scans, model units
/// @throws InvalidArgument if pixel_size is not positive and finite
[[nodiscard]] std::vector<std::uint8_t> unseen_samples(Rasterizer& rasterizer, const Scene& scene,
                                                       std::span<const Vec3> samples,
                                                       double pixel_size,
                                                       const Progress& progress = {});

}  // namespace rangezip
