#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/raster/framebuffer.h"
#include "core/view/view.h"

namespace rangezip {

/// Units of 2^-24 of the depth range, in which rasterizers count depth (R1), in one depth range.
inline constexpr double kDepthUnits = 16777216.0;

/// Eye depth in depth units, not rounded; depths outside of the view's planes count as on them.
[[nodiscard]] inline double depth_units(const View& view, double depth) {
  const Camera& camera = view.camera();
  return kDepthUnits *
         view.window_z_from_depth(std::clamp(depth, camera.near_depth, camera.far_depth));
}

/// The smallest band of depth units that holds [nearest, farthest].
struct DepthInterval {
  std::int32_t lower = 1;
  std::int32_t upper = 0;
};
[[nodiscard]] inline DepthInterval depth_interval(const View& view, double nearest,
                                                  double farthest) {
  return {static_cast<std::int32_t>(std::floor(depth_units(view, nearest))),
          static_cast<std::int32_t>(std::ceil(depth_units(view, farthest)))};
}

/// A band that takes nothing anywhere.
[[nodiscard]] inline DepthBand empty_band(Extent extent) {
  return {Grid<std::int32_t>(extent, DepthInterval{}.lower),
          Grid<std::int32_t>(extent, DepthInterval{}.upper)};
}

}  // namespace rangezip
