#include "core/view/camera.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/check_number.h"
#include "core/base/error.h"

namespace rangezip {

namespace {

/// The eight corners of a box.
std::array<Vec3, 8> corners_of(const Box& box) {
  std::array<Vec3, 8> corners;
  for (unsigned i = 0; i < 8; ++i) {
    corners[i] = {(i & 1U) != 0 ? box.upper.x : box.lower.x,
                  (i & 2U) != 0 ? box.upper.y : box.lower.y,
                  (i & 4U) != 0 ? box.upper.z : box.lower.z};
  }
  return corners;
}

Mat4 eye_from_world_of(const Vec3& eye, const Vec3& right, const Vec3& up, const Vec3& back) {
  Mat4 m{1.0};
  const std::array<Vec3, 3> axes{right, up, back};
  for (int row = 0; row < 3; ++row) {
    const Vec3& axis = axes[static_cast<std::size_t>(row)];
    for (int column = 0; column < 3; ++column)
      m[column][row] = axis[column];
    m[3][row] = -glm::dot(axis, eye);
  }
  return m;
}

Vec3 default_up(const Vec3& back) {
  return std::abs(back.y) < 0.9 ? Vec3{0.0, 1.0, 0.0} : Vec3{1.0, 0.0, 0.0};
}

}  // namespace

Camera look_at(const Vec3& eye, const Vec3& target, const Vec3& up, const Lens& lens) {
  const Vec3 back = eye - target;
  const double distance = glm::length(back);
  if (!(distance > 0.0) || !std::isfinite(distance)) {
    throw InvalidArgument("look_at: eye and target must be two finite points that differ");
  }
  const Vec3 z = back / distance;
  const Vec3 side = glm::cross(up, z);
  const double side_length = glm::length(side);
  if (!(side_length > 1e-9 * glm::length(up)) || !std::isfinite(side_length)) {
    throw InvalidArgument("look_at: up must not be zero or parallel to the line of sight");
  }
  const Vec3 x = side / side_length;
  return {.eye_from_world = eye_from_world_of(eye, x, glm::cross(z, x), z), .lens = lens};
}

Camera fit_depth_planes(Camera camera, const Box& bounds) {
  if (bounds.is_empty()) throw InvalidArgument("fit_depth_planes: bounds must not be empty");
  double nearest = std::numeric_limits<double>::infinity();
  double farthest = -std::numeric_limits<double>::infinity();
  for (const Vec3& corner : corners_of(bounds)) {
    const double depth = -(camera.eye_from_world * Vec4(corner, 1.0)).z;
    nearest = std::min(nearest, depth);
    farthest = std::max(farthest, depth);
  }
  // A flat object still needs a depth range; the offset guards against rounding far from 0.
  const double rounding = 1e-9 * std::max(std::abs(nearest), std::abs(farthest));
  const double margin =
      std::max({(farthest - nearest) / 256.0, rounding, 1e-6 * bounds.diagonal(), 1e-30});
  camera.near_depth = nearest - margin;
  camera.far_depth = farthest + margin;
  if (std::holds_alternative<Perspective>(camera.lens)) {
    camera.far_depth = std::max(camera.far_depth, margin);
    camera.near_depth = std::max(camera.near_depth, camera.far_depth * 1e-4);
  }
  return camera;
}

FramedCamera frame_box(const Box& bounds, const Vec3& toward_viewer, double pixel_size, int margin,
                       const std::optional<Vec3>& up) {
  check_positive("frame_box: pixel_size", pixel_size);
  if (bounds.is_empty()) throw InvalidArgument("frame_box: bounds must not be empty");
  const double length = glm::length(toward_viewer);
  if (!(length > 0.0) || !std::isfinite(length)) {
    throw InvalidArgument("frame_box: the direction must be finite and not zero");
  }
  const Vec3 back = toward_viewer / length;
  const Vec3 center = bounds.center();
  const double distance = std::max(bounds.diagonal(), pixel_size);
  Camera camera = look_at(center + back * distance, center, up.value_or(default_up(back)));

  double half_width = 0.0;
  double half_height = 0.0;
  for (const Vec3& corner : corners_of(bounds)) {
    const Vec4 eye = camera.eye_from_world * Vec4(corner, 1.0);
    half_width = std::max(half_width, std::abs(eye.x));
    half_height = std::max(half_height, std::abs(eye.y));
  }
  const auto pixels = [&](double half) {
    const double count = std::ceil(2.0 * half / pixel_size) + 2.0 * margin + 1.0;
    if (count > 1e6) {
      throw InvalidArgument(
          "frame_box: pixel_size is so small that an image of more than a million "
          "pixels across would be needed");
    }
    return static_cast<int>(count);
  };
  const Extent extent{pixels(half_width), pixels(half_height)};
  camera.lens = Orthographic{.height = pixel_size * extent.height};
  return {fit_depth_planes(std::move(camera), bounds), extent};
}

}  // namespace rangezip
