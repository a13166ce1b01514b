#pragma once

#include <cmath>

#include "core/image/range_image.h"
#include "tests/support/shapes.h"

/// Views and range images whose geometry is known in closed form.
namespace rangezip::images {

/// Looks down -z from the origin onto pixels of side `pixel_size`; depths are -z.
inline View parallel_view(Extent extent, double pixel_size = 1.0, double far_depth = 64.0) {
  return View(Camera{.lens = Orthographic{.height = pixel_size * extent.height},
                     .near_depth = 0.0,
                     .far_depth = far_depth},
              extent);
}

/// The same with a central projection of 53 degrees: the half height is half the depth.
inline View central_view(Extent extent, double near_depth = 1.0, double far_depth = 64.0) {
  return View(Camera{.lens = Perspective{.fov_y = 2.0 * std::atan(0.5)},
                     .near_depth = near_depth,
                     .far_depth = far_depth},
              extent);
}

/// depth_at(pixel) is the eye depth.
template <class F>
RangeImage image_of(const View& view, const F& depth_at) {
  RangeImage image(view);
  for (int y = 0; y < view.extent().height; ++y) {
    for (int x = 0; x < view.extent().width; ++x)
      image[{x, y}] = depth_at(Pixel{x, y});
  }
  return image;
}

/// The image seen in a mirror: left and right exchanged.
inline RangeImage mirrored(const RangeImage& image) {
  return image_of(image.view(), [&](Pixel p) {
    return image[{image.extent().width - 1 - p.x, p.y}];
  });
}

inline std::size_t sample_count(const RangeImage& image) {
  std::size_t count = 0;
  for (const double depth : image.depth().pixels())
    count += depth != kNoSample ? 1 : 0;
  return count;
}

inline std::size_t count_of(const Mask& mask) {
  std::size_t count = 0;
  for (const std::uint8_t pixel : mask.pixels())
    count += pixel != 0 ? 1 : 0;
  return count;
}

/// Depths of a bumpy sheet with noise, a step and holes: something for every rule to do.
inline RangeImage rough_image(Extent extent, std::uint64_t seed) {
  shapes::Random random(seed);
  return image_of(parallel_view(extent), [&](Pixel p) {
    const double sheet = p.x > extent.width / 2 ? 30.0 : 20.0;
    const double depth = sheet + 0.3 * p.x - 0.2 * p.y + random.between(-1.0, 1.0);
    return random.bits() % 6 == 0 ? kNoSample : depth;
  });
}

}  // namespace rangezip::images
