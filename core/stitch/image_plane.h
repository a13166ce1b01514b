#pragma once

#include <span>
#include <vector>

#include "core/base/geometry.h"
#include "core/stitch/predicates.h"
#include "core/view/view.h"

namespace rangezip {

/// Vertices as the scanner sees them. `points` are rounded to the grid of the stitcher; a vertex
/// more than 16384 px from the image is moved onto that limit, which bends the image of its faces.
struct ImagePlane {
  std::vector<GridPoint> points;
  std::vector<double> depths;  ///< eye depth; kBehindViewer where there is no image

  static constexpr double kBehindViewer = -1.0;
  [[nodiscard]] bool has_image(std::uint32_t vertex) const {
    return depths[vertex] != kBehindViewer;
  }
};

/// Projects all positions, once for a stitch. O(positions), parallel.
[[nodiscard]] ImagePlane project_to_image(std::span<const Vec3> positions, const View& view);

/// The grid point of a sample.
[[nodiscard]] inline GridPoint grid_point(Pixel pixel) {
  return {pixel.x * kGridStep, pixel.y * kGridStep};
}

/// A grid point in pixels, with sample (x, y) at (x, y): half a pixel less than in the window.
[[nodiscard]] inline Vec2 in_pixels(const GridPoint& p) {
  constexpr double kStep = 1.0 / static_cast<double>(kGridStep);
  return {static_cast<double>(p.x) * kStep, static_cast<double>(p.y) * kStep};
}

/// The pixel whose centre is nearest.
[[nodiscard]] inline Pixel nearest_pixel(const GridPoint& p) {
  return {static_cast<int>((p.x + kGridStep / 2) >> kGridBits),
          static_cast<int>((p.y + kGridStep / 2) >> kGridBits)};
}

}  // namespace rangezip
