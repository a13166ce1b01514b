#pragma once

#include <array>

#include "core/base/geometry.h"
#include "core/base/grid.h"
#include "core/view/camera.h"

namespace rangezip {

/// A camera with a pixel grid: the one map between world, window and pixels that all
/// rasterizers, every image pass and the stitcher share.
///
/// Window coordinates are those of OpenGL: x right and y up in pixels, z in [0, 1] from front to
/// back plane. Pixels are square. Eye depth is the distance along the line of sight, in model
/// units. An immutable value.
class View {
 public:
  /// @throws InvalidArgument if the extent is empty, a number is not finite, the lens is out of
  ///     range, the pose is not rigid (to 1e-6), near_depth >= far_depth, or a perspective lens
  ///     has near_depth <= 0.
  View(Camera camera, Extent extent);

  [[nodiscard]] const Camera& camera() const noexcept { return camera_; }
  [[nodiscard]] Extent extent() const noexcept { return extent_; }
  [[nodiscard]] bool is_perspective() const noexcept { return is_perspective_; }

  /// Maps a world point to (x w, y w, z w, w) of its window position; w = 1 for a parallel
  /// projection, the eye depth for a central one. The source of the rasterizer's rows (R1).
  [[nodiscard]] const Mat4& homogeneous_window_from_world() const noexcept {
    return homogeneous_window_from_world_;
  }

  [[nodiscard]] Vec3 window_from_world(const Vec3& point) const;
  [[nodiscard]] Vec3 world_from_window(const Vec3& window) const;

  [[nodiscard]] double depth_from_window_z(double window_z) const;
  [[nodiscard]] double window_z_from_depth(double depth) const;

  /// Eye depth of a world point.
  [[nodiscard]] double depth_of(const Vec3& point) const;

  /// The point at eye depth `depth` on the ray through the CENTRE of the pixel (the half-pixel
  /// shift of [Kobbelt, Botsch 2000, 4.1]).
  [[nodiscard]] Vec3 position(Pixel pixel, double depth) const;
  /// The same for any window position (x, y).
  [[nodiscard]] Vec3 position(const Vec2& window, double depth) const;

  /// Side of one pixel at eye depth `depth`, in model units: the finest edge a scan from this
  /// view can have.
  [[nodiscard]] double pixel_size(double depth) const;

  /// Unit vector from `point` to the viewer.
  [[nodiscard]] Vec3 toward_viewer(const Vec3& point) const;

  friend bool operator==(const View&, const View&) = default;

 private:
  Camera camera_;
  Extent extent_;
  bool is_perspective_ = false;
  double unit_pixel_size_ = 1.0;  ///< side of a pixel, at eye depth 1 for a central projection
  Mat4 homogeneous_window_from_world_{1.0};
  Mat4 world_from_eye_{1.0};
};

}  // namespace rangezip
