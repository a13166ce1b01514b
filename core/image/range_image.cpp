#include "core/image/range_image.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/image/item_lookup.h"

namespace rangezip {

namespace {

std::string text_of(Extent extent) {
  return std::to_string(extent.width) + " x " + std::to_string(extent.height);
}

/// Turns IDs back into depths, one view for all.
class Resolver {
 public:
  Resolver(const View& view, std::span<const DrawItem> items)
      : view_(view), items_(items), lookup_(items) {
    for (const DrawItem& item : items) {
      const Mat4 world_from_item =
          std::visit([](const auto& drawn) { return drawn.world_from_item; }, item);
      eye_from_item_.push_back(view.camera().eye_from_world * world_from_item);
    }
  }

  [[nodiscard]] double depth(Pixel pixel, PrimitiveId id) const {
    const std::size_t index = lookup_.find(id);
    if (index == ItemLookup::kNone) {
      throw InvalidArgument("make_range_image: ID " + std::to_string(id) + " of pixel (" +
                            std::to_string(pixel.x) + ", " + std::to_string(pixel.y) +
                            ") belongs to no item");
    }
    const std::uint32_t number = id - first_id(items_[index]);
    if (const auto* points = std::get_if<DrawPoints>(&items_[index])) {
      return -eye(index, points->positions[number]).z;
    }
    return depth_of_triangle(pixel, index, number);
  }

 private:
  [[nodiscard]] Vec3 eye(std::size_t item, const Vec3f& position) const {
    return Vec3(eye_from_item_[item] * Vec4(Vec3(position), 1.0));
  }

  /// Where the ray through the pixel centre meets the plane of the triangle. Depth is linear along
  /// the ray under both lenses, so two points of it are enough.
  [[nodiscard]] double depth_of_triangle(Pixel pixel, std::size_t item,
                                         std::uint32_t number) const {
    const auto& mesh = std::get<DrawTriangles>(items_[item]);
    const Triangle& corners = mesh.triangles[number];
    const Vec3 a = eye(item, mesh.positions[corners[0]]);
    const Vec3 b = eye(item, mesh.positions[corners[1]]);
    const Vec3 c = eye(item, mesh.positions[corners[2]]);
    const Camera& camera = view_.camera();
    const double nearest = std::max(-std::max({a.z, b.z, c.z}), camera.near_depth);
    const double farthest = std::min(-std::min({a.z, b.z, c.z}), camera.far_depth);

    const Vec3 normal = area_vector(a, b, c);
    const Vec3 front = eye_position(pixel, camera.near_depth);
    const Vec3 along = eye_position(pixel, camera.far_depth) - front;
    const double share = glm::dot(normal, a - front) / glm::dot(normal, along);
    const double depth = camera.near_depth + share * (camera.far_depth - camera.near_depth);
    // A plane that holds the ray has any depth or none: the comparison takes NaN to the nearest.
    return depth > nearest ? std::min(depth, std::max(nearest, farthest)) : nearest;
  }

  [[nodiscard]] Vec3 eye_position(Pixel pixel, double depth) const {
    const double scale = view_.pixel_size(depth);
    return {(pixel.x + 0.5 - 0.5 * view_.extent().width) * scale,
            (pixel.y + 0.5 - 0.5 * view_.extent().height) * scale, -depth};
  }

  const View& view_;
  std::span<const DrawItem> items_;
  ItemLookup lookup_;
  std::vector<Mat4> eye_from_item_;
};

/// The smaller of the two one-sided differences, halved where they disagree in sign. A side
/// without a sample gives an infinite or undefined difference and is left out.
double limited_difference(double before, double here, double after) {
  const bool has_before = before != kNoSample;
  const bool has_after = after != kNoSample;
  const double left = here - before;
  const double right = after - here;
  if (has_before && has_after) {
    if (std::abs(left) == std::abs(right)) return 0.5 * (left + right);
    const double smaller = std::abs(left) < std::abs(right) ? left : right;
    return left * right < 0.0 ? 0.5 * smaller : smaller;
  }
  if (has_before) return left;
  return has_after ? right : 0.0;
}

}  // namespace

RangeImage::RangeImage(View view) : view_(std::move(view)), depth_(view_.extent(), kNoSample) {}

RangeImage::RangeImage(View view, Grid<double> depth)
    : view_(std::move(view)), depth_(std::move(depth)) {
  if (depth_.extent() != view_.extent()) {
    throw InvalidArgument("RangeImage: depth is " + text_of(depth_.extent()) + ", the view " +
                          text_of(view_.extent()));
  }
  for (const double depth_here : depth_.pixels()) {
    if (!(depth_here > -kNoSample)) {
      throw InvalidArgument("RangeImage: a depth is NaN or -infinity");
    }
  }
}

RangeImage make_range_image(const View& view, const Framebuffer& framebuffer,
                            std::span<const DrawItem> items) {
  if (framebuffer.id.extent() != view.extent()) {
    throw InvalidArgument("make_range_image: framebuffer is " + text_of(framebuffer.id.extent()) +
                          ", the view " + text_of(view.extent()));
  }
  const Resolver resolver(view, items);
  Grid<double> depth(view.extent(), kNoSample);
  for_each_row(view.extent().height, [&](int y) {
    const std::span<const PrimitiveId> ids = framebuffer.id.row(y);
    const std::span<double> out = depth.row(y);
    for (std::size_t x = 0; x < ids.size(); ++x) {
      if (ids[x] != kNoPrimitive) out[x] = resolver.depth({static_cast<int>(x), y}, ids[x]);
    }
  });
  return {view, std::move(depth)};
}

glm::dvec2 estimate_slope(const RangeImage& image, Pixel pixel) {
  const Extent extent = image.extent();
  const auto depth_at = [&](int x, int y) {
    return extent.contains({x, y}) ? image[{x, y}] : kNoSample;
  };
  const double here = image[pixel];
  const double size = image.pixel_size(pixel);
  const auto slope = [&](double before, double after) {
    return std::clamp(limited_difference(before, here, after) / size, -kMaxSlope, kMaxSlope);
  };
  return {slope(depth_at(pixel.x - 1, pixel.y), depth_at(pixel.x + 1, pixel.y)),
          slope(depth_at(pixel.x, pixel.y - 1), depth_at(pixel.x, pixel.y + 1))};
}

SlopeImage estimate_slopes(const RangeImage& image) {
  SlopeImage slopes(image.extent(), glm::dvec2{0.0});
  for_each_row(image.extent().height, [&](int y) {
    for (Pixel p{0, y}; p.x < image.extent().width; ++p.x) {
      if (image.has_sample(p)) slopes[p] = estimate_slope(image, p);
    }
  });
  return slopes;
}

}  // namespace rangezip
