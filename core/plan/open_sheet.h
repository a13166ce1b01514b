#pragma once

#include <span>

#include "core/base/geometry.h"
#include "core/base/progress.h"
#include "core/raster/rasterizer.h"

namespace rangezip {

/// Whether the cloud is an open sheet, such as a terrain or one range scan: what is seen from one
/// side is seen from the other as well, while the two sides of a body show different points. Then a
/// visibility vote says little about which side is the outside, and the first view decides
/// (ViewPlanOptions::one_sided). True if more than 0.3 of what 20 directions or their
/// opposites show is seen from both (measured: single scans, terrains and half spheres 0.40 to
/// 0.58, bodies up to 0.20 where they are 2 pixel sides thick, with an opening up to 0.21). Asked
/// of 60,000 points; O(points), about 0.05 s.
/// @throws InvalidArgument if fewer than three distinct points are given.
[[nodiscard]] bool is_open_sheet(Rasterizer& rasterizer, std::span<const Vec3> points,
                                 const Progress& progress = {});

}  // namespace rangezip
