#include "core/view/view.h"

#include <cmath>
#include <string>

#include "core/base/check_number.h"
#include "core/base/deterministic_math.h"
#include "core/base/error.h"

namespace rangezip {

namespace {

bool is_finite(const Mat4& m) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      if (!std::isfinite(m[column][row])) return false;
    }
  }
  return true;
}

/// Whether the upper 3x3 part is a rotation and the last row is (0, 0, 0, 1).
bool is_rigid(const Mat4& m) {
  constexpr double kTolerance = 1e-6;
  const Mat3 rotation(m);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double expected = i == j ? 1.0 : 0.0;
      if (std::abs(glm::dot(rotation[i], rotation[j]) - expected) > kTolerance) return false;
    }
  }
  const double determinant = glm::dot(rotation[0], glm::cross(rotation[1], rotation[2]));
  return determinant > 0.0 && m[0][3] == 0.0 && m[1][3] == 0.0 && m[2][3] == 0.0 && m[3][3] == 1.0;
}

Mat4 inverse_of_rigid(const Mat4& m) {
  Mat4 inverse{1.0};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j)
      inverse[i][j] = m[j][i];
  }
  for (int i = 0; i < 3; ++i) {
    inverse[3][i] = -(inverse[0][i] * m[3][0] + inverse[1][i] * m[3][1] + inverse[2][i] * m[3][2]);
  }
  return inverse;
}

}  // namespace

View::View(Camera camera, Extent extent) : camera_(std::move(camera)), extent_(extent) {
  if (extent_.width < 1 || extent_.height < 1) {
    throw InvalidArgument("View: extent must be at least 1 x 1, got " +
                          std::to_string(extent_.width) + " x " + std::to_string(extent_.height));
  }
  const double near = camera_.near_depth;
  const double far = camera_.far_depth;
  if (!std::isfinite(near) || !std::isfinite(far) || !(near < far)) {
    throw InvalidArgument("View: near_depth must be finite and less than far_depth, got " +
                          std::to_string(near) + " and " + std::to_string(far));
  }
  if (!is_finite(camera_.eye_from_world) || !is_rigid(camera_.eye_from_world)) {
    throw InvalidArgument("View: eye_from_world must be a finite rigid motion");
  }
  for (const Plane& plane : camera_.clip_planes) {
    if (!std::isfinite(plane.offset) || !std::isfinite(glm::dot(plane.normal, plane.normal))) {
      throw InvalidArgument("View: a clip plane is not finite");
    }
  }

  Mat4 window_from_eye{0.0};
  const double half_width = 0.5 * extent_.width;
  const double half_height = 0.5 * extent_.height;
  if (const auto* lens = std::get_if<Orthographic>(&camera_.lens)) {
    check_positive("View: the orthographic height", lens->height);
    unit_pixel_size_ = lens->height / extent_.height;
    window_from_eye[0][0] = 1.0 / unit_pixel_size_;
    window_from_eye[1][1] = 1.0 / unit_pixel_size_;
    window_from_eye[2][2] = -1.0 / (far - near);
    window_from_eye[3] = {half_width, half_height, -near / (far - near), 1.0};
  } else {
    is_perspective_ = true;
    const double fov_y = std::get<Perspective>(camera_.lens).fov_y;
    if (!(fov_y > 0.0) || !(fov_y < std::numbers::pi)) {
      throw InvalidArgument("View: fov_y must lie in (0, pi), got " + std::to_string(fov_y));
    }
    if (!(near > 0.0)) {
      throw InvalidArgument("View: a perspective lens needs near_depth > 0, got " +
                            std::to_string(near));
    }
    unit_pixel_size_ = 2.0 * deterministic_tan(0.5 * fov_y) / extent_.height;
    window_from_eye[0][0] = 1.0 / unit_pixel_size_;
    window_from_eye[1][1] = 1.0 / unit_pixel_size_;
    window_from_eye[2] = {-half_width, -half_height, -far / (far - near), -1.0};
    window_from_eye[3][2] = -far * near / (far - near);
  }
  homogeneous_window_from_world_ = window_from_eye * camera_.eye_from_world;
  world_from_eye_ = inverse_of_rigid(camera_.eye_from_world);
}

Vec3 View::window_from_world(const Vec3& point) const {
  const Vec4 window = homogeneous_window_from_world_ * Vec4(point, 1.0);
  return is_perspective_ ? Vec3(window) / window.w : Vec3(window);
}

Vec3 View::world_from_window(const Vec3& window) const {
  return position(Vec2(window), depth_from_window_z(window.z));
}

double View::depth_from_window_z(double window_z) const {
  const double near = camera_.near_depth;
  const double far = camera_.far_depth;
  if (!is_perspective_) return near + window_z * (far - near);
  return far * near / (far - window_z * (far - near));
}

double View::window_z_from_depth(double depth) const {
  const double near = camera_.near_depth;
  const double far = camera_.far_depth;
  if (!is_perspective_) return (depth - near) / (far - near);
  return far * (depth - near) / (depth * (far - near));
}

double View::depth_of(const Vec3& point) const {
  return -(camera_.eye_from_world * Vec4(point, 1.0)).z;
}

Vec3 View::position(Pixel pixel, double depth) const {
  return position(Vec2{pixel.x + 0.5, pixel.y + 0.5}, depth);
}

Vec3 View::position(const Vec2& window, double depth) const {
  const double scale = pixel_size(depth);
  const Vec4 eye{(window.x - 0.5 * extent_.width) * scale,
                 (window.y - 0.5 * extent_.height) * scale, -depth, 1.0};
  return Vec3(world_from_eye_ * eye);
}

double View::pixel_size(double depth) const {
  return is_perspective_ ? unit_pixel_size_ * depth : unit_pixel_size_;
}

Vec3 View::toward_viewer(const Vec3& point) const {
  if (!is_perspective_) return Vec3(world_from_eye_[2]);
  return unit_or_z(Vec3(world_from_eye_[3]) - point);
}

}  // namespace rangezip
