#include "core/plan/front_sheet.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/base/error.h"

namespace rangezip {

namespace {

std::array<float, 4> row_of(const Mat4& m, int row, double scale) {
  return {static_cast<float>(scale * m[0][row]), static_cast<float>(scale * m[1][row]),
          static_cast<float>(scale * m[2][row]), static_cast<float>(scale * m[3][row])};
}

/// The upper median of the drawn neighbours' depths, or kNoDepth if fewer than four are drawn.
std::uint32_t median_around(std::span<const std::uint32_t> depth, std::size_t pixel,
                            std::size_t width) {
  const std::array<std::size_t, 8> around{pixel - width - 1, pixel - width,    pixel - width + 1,
                                          pixel - 1,         pixel + 1,        pixel + width - 1,
                                          pixel + width,     pixel + width + 1};
  std::array<std::uint32_t, 8> drawn{};
  std::size_t count = 0;
  for (const std::size_t neighbour : around) {
    if (depth[neighbour] != kNoDepth) drawn[count++] = depth[neighbour];
  }
  if (count < 4) return kNoDepth;
  const auto middle = drawn.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(drawn.begin(), middle, drawn.begin() + static_cast<std::ptrdiff_t>(count));
  return *middle;
}

}  // namespace

PointProjector::PointProjector(const View& view, const Mat4& world_from_item) {
  if (view.is_perspective()) {
    throw InvalidArgument("PointProjector: the view must be a parallel projection");
  }
  const Mat4 window_from_item = view.homogeneous_window_from_world() * world_from_item;
  x_ = row_of(window_from_item, 0, 1.0);
  y_ = row_of(window_from_item, 1, 1.0);
  z_ = row_of(window_from_item, 2, static_cast<double>(1U << kDepthBits));
  width_ = static_cast<float>(view.extent().width);
  height_ = static_cast<float>(view.extent().height);
  row_length_ = static_cast<std::uint32_t>(view.extent().width);
}

double depth_units_per_length(const View& view) {
  return static_cast<double>(1U << kDepthBits) /
         (view.camera().far_depth - view.camera().near_depth);
}

void close_front_sheet(Grid<std::uint32_t>& depth, std::uint32_t tolerance) {
  const Extent extent = depth.extent();
  const auto width = static_cast<std::size_t>(extent.width);
  const std::span<std::uint32_t> z = depth.pixels();
  const auto is_behind = [&](std::size_t pixel, std::uint32_t front) {
    return z[pixel] > front && z[pixel] - front > tolerance;
  };
  std::vector<std::pair<std::size_t, std::uint32_t>> moved;
  for (std::size_t y = 1; y + 1 < static_cast<std::size_t>(extent.height); ++y) {
    for (std::size_t x = 1; x + 1 < width; ++x) {
      const std::size_t pixel = y * width + x;
      if (z[pixel] == kNoDepth) continue;
      // Rare, so the median is found only where one of the four direct neighbours is in front.
      if (!is_behind(pixel, z[pixel - 1]) && !is_behind(pixel, z[pixel + 1]) &&
          !is_behind(pixel, z[pixel - width]) && !is_behind(pixel, z[pixel + width])) {
        continue;
      }
      const std::uint32_t median = median_around(z, pixel, width);
      if (is_behind(pixel, median)) moved.emplace_back(pixel, median);
    }
  }
  for (const auto& [pixel, median] : moved)
    z[pixel] = median;
}

namespace {

constexpr double kFrontDepth = 1.5;       ///< pixel sides within which a point is of the sheet
constexpr double kSeeThroughDepth = 2.5;  ///< pixel sides, see close_front_sheet()

View view_of_box(const Box& bounds, const Vec3& toward_viewer, double pixel_size) {
  FramedCamera framed = frame_box(bounds, toward_viewer, pixel_size);
  return {std::move(framed.camera), framed.extent};
}

}  // namespace

FrontSheet::FrontSheet(Rasterizer& rasterizer, std::span<const DrawItem> items, const Box& bounds,
                       const Vec3& toward_viewer, double pixel_size, Framebuffer& buffer)
    : view_(view_of_box(bounds, toward_viewer, pixel_size)) {
  rasterizer.render(view_, items, buffer);
  const double units_per_side = pixel_size * depth_units_per_length(view_);
  close_front_sheet(buffer.depth, static_cast<std::uint32_t>(kSeeThroughDepth * units_per_side));
  depth_ = buffer.depth.pixels();
  tolerance_ = static_cast<float>(kFrontDepth * units_per_side);
}

}  // namespace rangezip
