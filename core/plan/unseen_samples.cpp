#include "core/plan/unseen_samples.h"

#include <algorithm>
#include <cstddef>

#include "core/base/check_number.h"
#include "core/plan/directions.h"
#include "core/plan/front_sheet.h"
#include "core/plan/spacing.h"

namespace rangezip {

namespace {

constexpr int kDirections = 40;
constexpr double kFiner = 0.25;  ///< side of a pixel of the images, and tolerance, in h
constexpr double kMostPixelsAcross = 2048.0;

/// A sample, relative to the middle of the scene so that floats tell places apart.
struct Unseen {
  Vec3f place;
  std::size_t sample;
};

}  // namespace

std::vector<std::uint8_t> unseen_samples(Rasterizer& rasterizer, const Scene& scene,
                                         std::span<const Vec3> samples, double pixel_size,
                                         const Progress& progress) {
  check_positive("unseen_samples: pixel_size", pixel_size);
  const Box bounds = robust_bounds(scene);
  const double side = std::max(kFiner * pixel_size, bounds.diagonal() / kMostPixelsAcross);
  const Vec3 middle = bounds.center();
  Mat4 world_from_place(1.0);
  world_from_place[3] = Vec4(middle, 1.0);
  std::vector<Unseen> unseen;
  unseen.reserve(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i)
    unseen.push_back({Vec3f(samples[i] - middle), i});
  const std::vector<DrawItem> items = scene.draw_items();
  Framebuffer buffer;
  for (const Vec3& direction : sphere_directions(kDirections)) {
    if (unseen.empty()) break;
    progress.check_stop();
    const FramedCamera framed = frame_box(bounds, direction, side);
    const View view(framed.camera, framed.extent);
    rasterizer.render(view, items, buffer);
    const std::span<const std::uint32_t> depth = buffer.depth.pixels();
    const auto tolerance = static_cast<float>(side * depth_units_per_length(view));
    const PointProjector project(view, world_from_place);
    std::erase_if(unseen, [&](const Unseen& u) {
      const PointProjector::Place place = project(u.place);
      return place.pixel == PointProjector::kOutside ||
             place.depth <= static_cast<float>(depth[place.pixel]) + tolerance;
    });
  }
  std::vector<std::uint8_t> is_unseen(samples.size(), 0);
  for (const Unseen& u : unseen)
    is_unseen[u.sample] = 1;
  return is_unseen;
}

}  // namespace rangezip
