#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "core/base/geometry.h"
#include "core/raster/framebuffer.h"
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

}  // namespace rangezip
