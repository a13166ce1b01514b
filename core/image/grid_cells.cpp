#include "core/image/grid_cells.h"

#include <cmath>
#include <numbers>

#include "core/base/parallel.h"

namespace rangezip {

namespace {

/// Decides on single triangles.
class TriangleRule {
 public:
  TriangleRule(const RangeImage& image, const GridCellOptions& options)
      : image_(image),
        max_step_(options.max_edge * std::numbers::sqrt2),
        min_cosine_(options.min_cosine) {}

  [[nodiscard]] bool takes(const std::array<Pixel, 3>& corners) const {
    return is_connected(corners) && is_facing(corners);
  }

 private:
  [[nodiscard]] bool is_connected(const std::array<Pixel, 3>& corners) const {
    const double a = image_[corners[0]];
    const double b = image_[corners[1]];
    const double c = image_[corners[2]];
    const double nearest = std::min({a, b, c});
    return std::max({a, b, c}) - nearest <= max_step_ * image_.view().pixel_size(nearest);
  }

  [[nodiscard]] bool is_facing(const std::array<Pixel, 3>& corners) const {
    if (min_cosine_ <= 0.0) return true;
    const Vec3 a = eye_position(image_, corners[0]);
    const Vec3 b = eye_position(image_, corners[1]);
    const Vec3 c = eye_position(image_, corners[2]);
    const Vec3 normal = area_vector(a, b, c);
    const Vec3 sight = image_.view().is_perspective() ? -(a + b + c) : Vec3{0.0, 0.0, 1.0};
    const double along = glm::dot(normal, sight);
    return along * along >=
           min_cosine_ * min_cosine_ * glm::dot(normal, normal) * glm::dot(sight, sight);
  }

  const RangeImage& image_;
  double max_step_;
  double min_cosine_;
};

/// The cell's diagonal and the triangles that its active corners allow.
std::uint8_t possible_triangles(const RangeImage& image, const Mask& active, Pixel cell) {
  const std::array<Pixel, 4> corners{
      {cell, {cell.x + 1, cell.y}, {cell.x + 1, cell.y + 1}, {cell.x, cell.y + 1}}};
  int count = 0;
  std::size_t missing = 4;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (active[corners[i]] != 0 && image.has_sample(corners[i])) {
      ++count;
    } else {
      missing = i;
    }
  }
  if (count < 3) return 0;
  switch (missing) {
    case 0:
      return kFallingDiagonal | kUpperTriangle;
    case 1:
      return kUpperTriangle;
    case 2:
      return kFallingDiagonal | kLowerTriangle;
    case 3:
      return kLowerTriangle;
    default:
      break;
  }
  const double rising = std::abs(image[corners[0]] - image[corners[2]]);
  const double falling = std::abs(image[corners[1]] - image[corners[3]]);
  return static_cast<std::uint8_t>((rising <= falling ? 0 : kFallingDiagonal) | kLowerTriangle |
                                   kUpperTriangle);
}

std::uint8_t triangles_of(const RangeImage& image, const Mask& active, const TriangleRule& rule,
                          Pixel cell) {
  const std::uint8_t possible = possible_triangles(image, active, cell);
  unsigned bits = 0;
  for (const std::uint8_t which : {kLowerTriangle, kUpperTriangle}) {
    if ((possible & which) != 0 && rule.takes(grid_triangle(cell, possible, which))) bits |= which;
  }
  return bits == 0 ? std::uint8_t{0}
                   : static_cast<std::uint8_t>(bits | (possible & kFallingDiagonal));
}

}  // namespace

std::array<Pixel, 3> grid_triangle(Pixel cell, std::uint8_t bits, std::uint8_t triangle) {
  const Pixel a = cell;
  const Pixel b{cell.x + 1, cell.y};
  const Pixel c{cell.x + 1, cell.y + 1};
  const Pixel d{cell.x, cell.y + 1};
  if ((bits & kFallingDiagonal) != 0) {
    return triangle == kLowerTriangle ? std::array{a, b, d} : std::array{b, c, d};
  }
  return triangle == kLowerTriangle ? std::array{a, b, c} : std::array{a, c, d};
}

Vec3 eye_position(const RangeImage& image, Pixel pixel) {
  const double depth = image[pixel];
  const double scale = image.view().pixel_size(depth);
  return {(pixel.x + 0.5 - 0.5 * image.extent().width) * scale,
          (pixel.y + 0.5 - 0.5 * image.extent().height) * scale, -depth};
}

GridCells build_grid_cells(const RangeImage& image, const Mask& active,
                           const GridCellOptions& options) {
  const TriangleRule rule(image, options);
  GridCells cells(image.extent(), 0);
  for_each_row(image.extent().height - 1, [&](int y) {
    for (Pixel cell{0, y}; cell.x + 1 < image.extent().width; ++cell.x) {
      cells[cell] = triangles_of(image, active, rule, cell);
    }
  });
  return cells;
}

}  // namespace rangezip
