#include "core/stitch/image_plane.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"

namespace rangezip {

namespace {

constexpr std::size_t kVerticesPerBlock = 4096;

std::int64_t grid_coordinate(double window) {
  constexpr auto kLimit = static_cast<double>(kGridLimit);
  const double steps = (window - 0.5) * static_cast<double>(kGridStep);
  return static_cast<std::int64_t>(std::floor(std::clamp(steps, -kLimit, kLimit) + 0.5));
}

}  // namespace

ImagePlane project_to_image(std::span<const Vec3> positions, const View& view) {
  ImagePlane image;
  image.points.resize(positions.size());
  image.depths.resize(positions.size());
  parallel_for(positions.size(), kVerticesPerBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double depth = view.depth_of(positions[i]);
      if (view.is_perspective() && !(depth > 0.0)) {
        image.depths[i] = ImagePlane::kBehindViewer;
        continue;
      }
      const Vec3 window = view.window_from_world(positions[i]);
      image.points[i] = {grid_coordinate(window.x), grid_coordinate(window.y)};
      image.depths[i] = depth;
    }
  });
  return image;
}

}  // namespace rangezip
