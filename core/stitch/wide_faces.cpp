#include "core/stitch/wide_faces.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rangezip {

namespace {

/// Cells along one axis of the search grid, at most.
constexpr std::int64_t kMostCells = 256;

bool covers(const Triangle& face, const ImagePlane& image, const GridPoint& place) {
  const GridPoint& a = image.points[face[0]];
  const GridPoint& b = image.points[face[1]];
  const GridPoint& c = image.points[face[2]];
  return orientation(a, b, place) >= 0 && orientation(b, c, place) >= 0 &&
         orientation(c, a, place) >= 0;
}

}  // namespace

double longest_side_in_image(const Triangle& face, const ImagePlane& image) {
  double longest = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 side = in_pixels(image.points[face[k]]) - in_pixels(image.points[face[(k + 1) % 3]]);
    longest = std::max(longest, glm::dot(side, side));
  }
  return std::sqrt(longest);
}

WideFaces::WideFaces(std::vector<Triangle> faces, const ImagePlane& image)
    : faces_(std::move(faces)), image_(&image) {
  if (faces_.empty()) return;
  origin_ = image.points[faces_[0][0]];
  GridPoint end = origin_;
  for (const Triangle& face : faces_) {
    for (const std::uint32_t v : face) {
      const GridPoint& p = image.points[v];
      origin_ = {std::min(origin_.x, p.x), std::min(origin_.y, p.y)};
      end = {std::max(end.x, p.x), std::max(end.y, p.y)};
    }
  }
  // Cells of the size of the smallest wide faces, unless these are too many.
  const std::int64_t extent = std::max(end.x - origin_.x, end.y - origin_.y) + 1;
  cell_side_ = std::max(static_cast<std::int64_t>(kWideFace) * kGridStep, extent / kMostCells + 1);
  cells_ = {static_cast<int>((end.x - origin_.x) / cell_side_) + 1,
            static_cast<int>((end.y - origin_.y) / cell_side_) + 1};

  begins_.assign(cells_.count() + 1, 0);
  const auto for_each_cell = [&](const auto& body) {
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
      const Box box = cells_of(faces_[f]);
      for (int y = box.first.y; y <= box.last.y; ++y) {
        for (int x = box.first.x; x <= box.last.x; ++x)
          body(cells_.index({x, y}), f);
      }
    }
  };
  for_each_cell([&](std::size_t cell, std::uint32_t) { ++begins_[cell + 1]; });
  std::partial_sum(begins_.begin(), begins_.end(), begins_.begin());
  listed_.resize(begins_.back());
  std::vector<std::uint32_t> next = begins_;
  for_each_cell([&](std::size_t cell, std::uint32_t f) { listed_[next[cell]++] = f; });
}

Pixel WideFaces::cell_of(const GridPoint& p) const {
  return {static_cast<int>((p.x - origin_.x) / cell_side_),
          static_cast<int>((p.y - origin_.y) / cell_side_)};
}

WideFaces::Box WideFaces::cells_of(const Triangle& face) const {
  Box box{cell_of(image_->points[face[0]]), cell_of(image_->points[face[0]])};
  for (const std::uint32_t v : face) {
    const Pixel cell = cell_of(image_->points[v]);
    box.first = {std::min(box.first.x, cell.x), std::min(box.first.y, cell.y)};
    box.last = {std::max(box.last.x, cell.x), std::max(box.last.y, cell.y)};
  }
  return box;
}

double WideFaces::longest_side_at(const GridPoint& place) const {
  if (faces_.empty() || place.x < origin_.x || place.y < origin_.y) return 0.0;
  const Pixel cell = cell_of(place);
  if (!cells_.contains(cell)) return 0.0;
  const std::size_t index = cells_.index(cell);
  double longest = 0.0;
  for (std::uint32_t i = begins_[index]; i < begins_[index + 1]; ++i) {
    const Triangle& face = faces_[listed_[i]];
    if (covers(face, *image_, place)) {
      longest = std::max(longest, longest_side_in_image(face, *image_));
    }
  }
  return longest;
}

}  // namespace rangezip
