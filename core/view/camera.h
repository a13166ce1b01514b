#pragma once

#include <numbers>
#include <variant>
#include <vector>

#include "core/base/geometry.h"
#include "core/base/grid.h"

namespace rangezip {

/// Parallel projection; `height` is the visible height in model units.
struct Orthographic {
  double height = 2.0;

  friend bool operator==(const Orthographic&, const Orthographic&) = default;
};

/// Central projection; `fov_y` is the full vertical angle in radians, in (0, pi).
struct Perspective {
  double fov_y = std::numbers::pi / 4;

  friend bool operator==(const Perspective&, const Perspective&) = default;
};

using Lens = std::variant<Orthographic, Perspective>;

/// What a user or a planner adjusts before a scan: where the virtual scanner stands, how it
/// sees, and what it cuts away. Plain data; a View checks it.
struct Camera {
  Mat4 eye_from_world{1.0};  ///< rigid; the eye looks down its own -z axis
  Lens lens = Orthographic{};
  double near_depth = 0.1;         ///< eye depth of the front plane, model units
  double far_depth = 10.0;         ///< eye depth of the back plane, greater than near_depth
  std::vector<Plane> clip_planes;  ///< world space; what lies outside of any is not seen

  friend bool operator==(const Camera&, const Camera&) = default;
};

/// A camera that stands at `eye` and looks at `target`.
/// @throws InvalidArgument if the two coincide or `up` is parallel to the line of sight.
[[nodiscard]] Camera look_at(const Vec3& eye, const Vec3& target, const Vec3& up,
                             const Lens& lens = Orthographic{});

/// The same camera with the front and back plane as close to `bounds` as they can be, which
/// makes the depth steps smallest [Kobbelt, Botsch 2000, 4.2]. A margin of 1/256 of the depth
/// range (plus rounding) keeps what lies on the box visible. Under a perspective lens the front
/// plane stays in front of the eye.
[[nodiscard]] Camera fit_depth_planes(Camera camera, const Box& bounds);

/// An orthographic camera and the extent that show all of `bounds` with square pixels.
struct FramedCamera {
  Camera camera;
  Extent extent;
};

/// The orthographic camera that looks along -`toward_viewer` at the centre of `bounds`, its
/// pixels of side `pixel_size`, the image as small as it can be around the box plus `margin`
/// pixels on each side, the depth planes fitted.
/// `up` defaults to y, or x where the view is nearly along y.
/// @param toward_viewer from the object to the scanner; any length but 0
/// @throws InvalidArgument if pixel_size <= 0, bounds are empty, or the direction is zero.
[[nodiscard]] FramedCamera frame_box(const Box& bounds, const Vec3& toward_viewer,
                                     double pixel_size, int margin = 4,
                                     const std::optional<Vec3>& up = std::nullopt);

}  // namespace rangezip
