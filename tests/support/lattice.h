#pragma once

#include <cstdint>
#include <vector>

#include "core/raster/draw_item.h"
#include "core/raster/framebuffer.h"
#include "core/view/view.h"

/// Scenes given directly in the rasterizer's integers, so that a test can say where a corner lies
/// to 1/256 pixel: x and y in 1/256 pixel from the lower left corner of the window, z in 2^-24 of
/// the depth range.
namespace rangezip::lattice {

/// A view with one model unit a pixel and depths from 0 to 1.
inline View view(Extent extent) {
  return View({.lens = Orthographic{.height = static_cast<double>(extent.height)},
               .near_depth = 0.0,
               .far_depth = 1.0},
              extent);
}

/// The placement under which the rows of view(extent) (R1) are the identity: all factors are
/// powers of two, so nothing is rounded, and a position's integers are its snapped integers.
inline Mat4 placement(Extent extent) {
  Mat4 m{1.0};
  m[0][0] = 1.0 / 256.0;
  m[1][1] = 1.0 / 256.0;
  m[2][2] = -1.0 / 16777216.0;
  m[3] = {-0.5 * extent.width, -0.5 * extent.height, 0.0, 1.0};
  return m;
}

/// Whole pixels in 1/256 pixel.
constexpr float px(double pixels) {
  return static_cast<float>(pixels * 256.0);
}

inline DrawPoints points(Extent extent, const std::vector<Vec3f>& positions,
                         PrimitiveId first_id = 0, int point_size = 1) {
  return {.positions = positions,
          .world_from_item = placement(extent),
          .first_id = first_id,
          .point_size = point_size};
}

inline DrawTriangles triangles(Extent extent, const std::vector<Vec3f>& positions,
                               const std::vector<Triangle>& corners, PrimitiveId first_id = 0) {
  return {.positions = positions,
          .triangles = corners,
          .world_from_item = placement(extent),
          .first_id = first_id};
}

/// A band that takes every depth.
inline DepthBand whole_band(Extent extent) {
  return {.lower = Grid<std::int32_t>(extent, 0),
          .upper = Grid<std::int32_t>(extent, static_cast<std::int32_t>(kMaxDepth))};
}

/// Every depth, measured from `reference`.
inline AccumulateWindow whole_window(Extent extent, std::int32_t reference, int shift) {
  return {.band = whole_band(extent),
          .reference = Grid<std::int32_t>(extent, reference),
          .shift = shift};
}

}  // namespace rangezip::lattice
