#pragma once

#include <span>

#include "core/base/geometry.h"
#include "core/base/progress.h"
#include "core/raster/rasterizer.h"

namespace rangezip {

/// Whether the cloud is an open sheet, such as a terrain or one range scan, that is seen from both
/// sides about equally: then a visibility vote says little about which side is the outside, and the
/// first view decides (ViewPlanOptions::one_sided). True if the median length of the votes is below
/// 0.6 of a full one (measured: bodies 0.78 and more, also with a side missing; sheets 0.17 to
/// 0.51). Votes on a subset of 60,000 points; O(points), about 0.05 s.
/// @throws InvalidArgument if fewer than three distinct points are given.
[[nodiscard]] bool is_open_sheet(Rasterizer& rasterizer, std::span<const Vec3> points,
                                 const Progress& progress = {});

}  // namespace rangezip
