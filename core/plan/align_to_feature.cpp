#include "core/plan/align_to_feature.h"

#include <algorithm>
#include <cmath>
#include <variant>

namespace rangezip {

namespace {

constexpr int kMargin = 4;  ///< pixels around the samples

/// A rotation of the image about its middle: (x, y) becomes (c x - s y, s x + c y).
struct Turn {
  double c = 1.0;
  double s = 0.0;

  [[nodiscard]] Vec2 of(const Vec2& p) const { return {c * p.x - s * p.y, s * p.x + c * p.y}; }
};

/// The turn that brings a normal onto the nearest axis.
Turn turn_to_axis(const Vec2& normal) {
  if (std::abs(normal.x) >= std::abs(normal.y)) {
    const double sign = normal.x < 0.0 ? -1.0 : 1.0;
    return {sign * normal.x, -sign * normal.y};
  }
  const double sign = normal.y < 0.0 ? -1.0 : 1.0;
  return {sign * normal.y, sign * normal.x};
}

Vec2 middle_of(Extent extent) {
  return {0.5 * extent.width, 0.5 * extent.height};
}

/// The image around the same axis that shows all samples after the turn.
Extent extent_after(const RangeImage& image, const Turn& turn) {
  Vec2 half{0.0, 0.0};
  for (int y = 0; y < image.extent().height; ++y) {
    for (Pixel p{0, y}; p.x < image.extent().width; ++p.x) {
      if (!image.has_sample(p)) continue;
      const Vec2 turned = turn.of(Vec2{p.x + 0.5, p.y + 0.5} - middle_of(image.extent()));
      half = {std::max(half.x, std::abs(turned.x)), std::max(half.y, std::abs(turned.y))};
    }
  }
  const auto pixels = [](double size) {
    return 2 * static_cast<int>(std::ceil(size)) + 2 * kMargin + 1;
  };
  return {pixels(half.x), pixels(half.y)};
}

/// Turns the eye's frame about the line of sight, or tilts it about another of its axes.
void turn_axes(Mat4& eye_from_world, int first, int second, const Turn& turn) {
  for (int column = 0; column < 4; ++column) {
    const Vec2 turned = turn.of({eye_from_world[column][first], eye_from_world[column][second]});
    eye_from_world[column][first] = turned.x;
    eye_from_world[column][second] = turned.y;
  }
}

/// By how much a line at this offset from the middle of `pixels` pixels has to move to run through
/// their centres.
double way_to_centre(double offset, int pixels) {
  const double place = offset + 0.5 * pixels;
  return std::floor(place) + 0.5 - place;
}

/// Tilts a central projection so that what is seen `offset` pixels from the middle along an axis is
/// seen `way` farther.
void tilt(Camera& camera, int axis, double offset, double way, double focal_length) {
  const Vec2 before = glm::normalize(Vec2{offset, focal_length});
  const Vec2 after = glm::normalize(Vec2{offset + way, focal_length});
  // The eye looks along -z: a turn of (sideways, -z) is one of (sideways, z) the other way round.
  const Turn turn{glm::dot(before, after), before.y * after.x - before.x * after.y};
  turn_axes(camera.eye_from_world, axis, 2, turn);
}

}  // namespace

std::optional<AlignedCamera> align_to_feature(const RangeImage& image) {
  const auto line = find_feature_line(image);
  if (!line) return std::nullopt;
  const View& view = image.view();
  AlignedCamera aligned{.camera = view.camera(), .extent = image.extent(), .line = *line};
  const Turn turn = turn_to_axis(line->normal);
  turn_axes(aligned.camera.eye_from_world, 0, 1, turn);
  const int axis = std::abs(line->normal.x) >= std::abs(line->normal.y) ? 0 : 1;
  const double sign = line->normal[axis] < 0.0 ? -1.0 : 1.0;
  const double offset = sign * (line->offset - glm::dot(line->normal, middle_of(image.extent())));
  if (auto* lens = std::get_if<Orthographic>(&aligned.camera.lens)) {
    const double side = lens->height / image.extent().height;
    aligned.extent = extent_after(image, turn);
    lens->height = side * aligned.extent.height;
    const int pixels = axis == 0 ? aligned.extent.width : aligned.extent.height;
    aligned.camera.eye_from_world[3][axis] += side * way_to_centre(offset, pixels);
  } else {
    const int pixels = axis == 0 ? aligned.extent.width : aligned.extent.height;
    tilt(aligned.camera, axis, offset, way_to_centre(offset, pixels), 1.0 / view.pixel_size(1.0));
  }
  return aligned;
}

}  // namespace rangezip
