#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include <glm/vec2.hpp>

#include "core/base/grid.h"
#include "core/raster/framebuffer.h"
#include "core/view/view.h"

namespace rangezip {

/// Eye depth of a pixel that saw nothing: infinitely far. Unlike NaN it equals itself, sorts
/// last, and spoils every average it slips into.
inline constexpr double kNoSample = std::numeric_limits<double>::infinity();

/// A depth for every pixel, together with the view that gives the depths their place in the
/// world. The two never part, so no sample can be un-projected with the wrong matrix.
///
/// Holds eye depth, not window z: means and differences of it are lengths in model units under
/// both lenses.
class RangeImage {
 public:
  /// An image without samples.
  explicit RangeImage(View view);

  /// @throws InvalidArgument if the extents differ or a depth is NaN or -infinity.
  RangeImage(View view, Grid<double> depth);

  [[nodiscard]] const View& view() const noexcept { return view_; }
  [[nodiscard]] Extent extent() const noexcept { return view_.extent(); }

  [[nodiscard]] double& operator[](Pixel p) { return depth_[p]; }
  [[nodiscard]] double operator[](Pixel p) const { return depth_[p]; }
  [[nodiscard]] std::span<double> row(int y) { return depth_.row(y); }
  [[nodiscard]] std::span<const double> row(int y) const { return depth_.row(y); }
  [[nodiscard]] const Grid<double>& depth() const noexcept { return depth_; }

  [[nodiscard]] bool has_sample(Pixel p) const { return depth_[p] != kNoSample; }

  /// World position of the sample. @pre has_sample(p).
  [[nodiscard]] Vec3 position(Pixel p) const { return view_.position(p, depth_[p]); }

  /// Side of a pixel at the sample, model units. @pre has_sample(p).
  [[nodiscard]] double pixel_size(Pixel p) const { return view_.pixel_size(depth_[p]); }

  friend bool operator==(const RangeImage&, const RangeImage&) = default;

 private:
  View view_;
  Grid<double> depth_;
};

/// Which pixels take part: 1 active, 0 not. One byte a pixel, so that it is a span, a NumPy array
/// and a GL upload as it is.
using Mask = Grid<std::uint8_t>;

/// Tilt of the surface at each sample: change of eye depth from pixel to pixel, to the right (x)
/// and up (y), in pixel sides at the sample, thus dimensionless; (0, 0) faces the viewer, length 1
/// is 45 degrees. Clamped to kMaxSlope per axis; (0, 0) where there is no sample.
using SlopeImage = Grid<glm::dvec2>;
inline constexpr double kMaxSlope = 4.0;

/// The range image of what was drawn, resolved from the IDs in double (R10): a point's own eye
/// depth, a triangle's plane at the pixel centre (clamped to the depths of its corners and the
/// depth planes, since a plane seen on edge has no depth); empty pixels kNoSample.
/// @param items what `framebuffer` was drawn from under `view`
/// @throws InvalidArgument if the extents differ or an ID belongs to no item.
[[nodiscard]] RangeImage make_range_image(const View& view, const Framebuffer& framebuffer,
                                          std::span<const DrawItem> items);

/// Slopes by differences to the neighbours: of the two one-sided differences per axis the smaller,
/// halved where they disagree in sign (minmod), which keeps steps of depth from tilting what lies
/// beside them. O(pixels).
[[nodiscard]] SlopeImage estimate_slopes(const RangeImage& image);

/// The same for one pixel. @pre has_sample(pixel)
[[nodiscard]] glm::dvec2 estimate_slope(const RangeImage& image, Pixel pixel);

/// sqrt(1 + slope^2): by how much a step of one pixel is longer on the surface than on the grid.
[[nodiscard]] inline double stretch_of(const glm::dvec2& slope) {
  return glm::length(Vec3{slope.x, slope.y, 1.0});
}

}  // namespace rangezip
