#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/geometry.h"
#include "core/base/progress.h"
#include "core/raster/rasterizer.h"
#include "core/scene/scene.h"

namespace rangezip {

/// Flags (1) of samples of a scene's triangles that nothing shows (unseen_samples()): the walls
/// within walls and parts within parts of assemblies. Where bodies stand apart (are_outer()), they
/// are the ground of grooves and cavities, and not hidden.
/// @param samples world coordinates, on triangles of the scene (area_samples())
/// @param pixel_size of the scans, model units
/// @throws InvalidArgument if pixel_size is not positive and finite
/// Cost: that of both; the second only if there are unseen ones.
[[nodiscard]] std::vector<std::uint8_t> hidden_samples(Rasterizer& rasterizer, const Scene& scene,
                                                       std::span<const Vec3> samples,
                                                       double pixel_size,
                                                       const Progress& progress = {});

}  // namespace rangezip
