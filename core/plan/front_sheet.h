#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include "core/base/geometry.h"
#include "core/base/parallel.h"
#include "core/raster/draw_item.h"
#include "core/raster/framebuffer.h"
#include "core/raster/rasterizer.h"
#include "core/view/view.h"

namespace rangezip {

/// Where a point of an item falls in a view of parallel projection. Float rows, as a rasterizer
/// has them (R1, R2); it may differ from the rasterizer in the pixel for points that lie on the
/// line between two, which no decision here depends on.
class PointProjector {
 public:
  /// An index that no pixel has.
  static constexpr std::uint32_t kOutside = std::numeric_limits<std::uint32_t>::max();

  struct Place {
    std::uint32_t pixel = kOutside;  ///< row-major, bottom row first
    float depth = 0.0F;              ///< framebuffer units
  };

  /// @throws InvalidArgument for a perspective view
  PointProjector(const View& view, const Mat4& world_from_item);

  [[nodiscard]] Place operator()(const Vec3f& p) const noexcept {
    const float x = ((x_[0] * p.x + x_[1] * p.y) + x_[2] * p.z) + x_[3];
    const float y = ((y_[0] * p.x + y_[1] * p.y) + y_[2] * p.z) + y_[3];
    if (!(x >= 0.0F && x < width_ && y >= 0.0F && y < height_)) return {};
    const auto pixel = static_cast<std::uint32_t>(y) * row_length_ + static_cast<std::uint32_t>(x);
    return {pixel, ((z_[0] * p.x + z_[1] * p.y) + z_[2] * p.z) + z_[3]};
  }

 private:
  std::array<float, 4> x_;  ///< pixels
  std::array<float, 4> y_;
  std::array<float, 4> z_;  ///< framebuffer depth units
  float width_;
  float height_;
  std::uint32_t row_length_;
};

/// Framebuffer depth units in one model unit along the line of sight of a parallel view.
[[nodiscard]] double depth_units_per_length(const View& view);

/// Moves samples that were seen through a gap of the front sheet onto it: those that lie more than
/// `tolerance` (framebuffer units) behind the median of their at least four drawn neighbours get
/// that median. The images of a planner are small and sparse; this is a cheap stand-in for
/// remove_see_through().
void close_front_sheet(Grid<std::uint32_t>& depth, std::uint32_t tolerance);

/// What is seen from one direction: the points within 1.5 pixel sides of the closed front sheet.
class FrontSheet {
 public:
  /// Draws the items.
  /// @param pixel_size of the image, model units
  /// @param buffer holds the sheet as long as it is asked for
  FrontSheet(Rasterizer& rasterizer, std::span<const DrawItem> items, const Box& bounds,
             const Vec3& toward_viewer, double pixel_size, Framebuffer& buffer);

  /// Visits the indices of the points of one of the items that are seen, in parallel.
  template <class Visit>
  void for_each_seen(const DrawPoints& cloud, const Visit& visit) const {
    const PointProjector project(view_, cloud.world_from_item);
    parallel_for(cloud.positions.size(), kPointsPerBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const PointProjector::Place place = project(cloud.positions[i]);
        if (place.pixel == PointProjector::kOutside) continue;
        if (place.depth <= static_cast<float>(depth_[place.pixel]) + tolerance_) visit(i);
      }
    });
  }

 private:
  static constexpr std::size_t kPointsPerBlock = 1U << 15U;

  View view_;
  std::span<const std::uint32_t> depth_;
  float tolerance_ = 0.0F;  ///< framebuffer units
};

}  // namespace rangezip
