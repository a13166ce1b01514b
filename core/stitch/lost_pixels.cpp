#include "core/stitch/lost_pixels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "core/image/range_image.h"
#include "core/stitch/pixel_box.h"

namespace rangezip {

namespace {

/// How far the new surface may be from the old one in depth, in pixel sides times stretch.
constexpr double kDepthTolerance = 3.0;

/// Faces steeper than this (tangent) get no wider tolerance.
constexpr double kMostSlope = 4.0;

/// One face in the image.
struct FaceImage {
  std::array<GridPoint, 3> corners;
  std::array<double, 3> depths{};

  FaceImage(const Triangle& face, const ImagePlane& image) {
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = image.points[face[k]];
      depths[k] = image.depths[face[k]];
    }
  }

  [[nodiscard]] bool is_visible() const {
    return std::find(depths.begin(), depths.end(), ImagePlane::kBehindViewer) == depths.end();
  }

  /// The pixels whose centres lie in the box around the face.
  [[nodiscard]] PixelBox box() const {
    const auto [left, right] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
    const auto [bottom, top] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
    const auto up = [](std::int64_t x) {
      return static_cast<int>((x + kGridStep - 1) >> kGridBits);
    };
    const auto down = [](std::int64_t x) { return static_cast<int>(x >> kGridBits); };
    return {{up(left), up(bottom)}, {down(right), down(top)}};
  }

  /// Calls visit(pixel, depth) for the centres that the face covers, its border included.
  template <class Visit>
  void for_each_pixel(const PixelBox& limit, const Visit& visit) const {
    const PixelBox box = this->box().within(limit);
    if (box.is_empty()) return;
    const std::int64_t area = orientation(corners[0], corners[1], corners[2]);
    for (int y = box.first.y; y <= box.last.y; ++y) {
      for (int x = box.first.x; x <= box.last.x; ++x)
        visit_if_covered({x, y}, area, visit);
    }
  }

 private:
  template <class Visit>
  void visit_if_covered(Pixel pixel, std::int64_t area, const Visit& visit) const {
    const GridPoint p = grid_point(pixel);
    std::array<std::int64_t, 3> parts{};  // of the area, opposite to each corner
    bool is_left = false;
    bool is_right = false;
    for (std::size_t k = 0; k < 3; ++k) {
      parts[k] = orientation(corners[(k + 1) % 3], corners[(k + 2) % 3], p);
      is_left = is_left || parts[k] > 0;
      is_right = is_right || parts[k] < 0;
    }
    if (is_left && is_right) return;
    if (area == 0) {  // seen exactly on edge: p is on its line, maybe beyond its ends
      visit(pixel, (depths[0] + depths[1] + depths[2]) / 3.0);
      return;
    }
    double depth = 0.0;
    for (std::size_t k = 0; k < 3; ++k)
      depth += static_cast<double>(parts[k]) * depths[k];
    visit(pixel, depth / static_cast<double>(area));
  }
};

/// Change of a face's depth over the image, as a tangent, at most kMostSlope.
double slope_of(const FaceImage& face, double pixel_side) {
  const Vec2 a = in_pixels(face.corners[1]) - in_pixels(face.corners[0]);
  const Vec2 b = in_pixels(face.corners[2]) - in_pixels(face.corners[0]);
  const double area = a.x * b.y - a.y * b.x;
  const double along_a = face.depths[1] - face.depths[0];
  const double along_b = face.depths[2] - face.depths[0];
  const Vec2 gradient{along_a * b.y - along_b * a.y, along_b * a.x - along_a * b.x};
  const double slope = glm::length(gradient);
  const double limit = kMostSlope * pixel_side * std::abs(area);
  return slope < limit ? slope / (pixel_side * std::abs(area)) : kMostSlope;
}

/// A place of a face that is gone.
struct Place {
  Pixel pixel;
  double depth = 0.0;
  double tolerance = 0.0;
};

/// What is left of the places of faces that are gone.
class LostPixels {
 public:
  LostPixels(const SeenMesh& before, const FaceChanges& changes, const View& view);

  /// Forgets the places that one of the faces covers at about their depth.
  void cover_by(std::span<const Triangle> faces, const ImagePlane& image);

  [[nodiscard]] std::vector<Pixel> pixels() const;

 private:
  /// Of the faces over a pixel; those in between are not asked.
  struct Depths {
    double nearest = kNoSample;
    double farthest = -kNoSample;
    bool operator==(const Depths&) const = default;
  };

  std::vector<Place> places_;
};

LostPixels::LostPixels(const SeenMesh& before, const FaceChanges& changes, const View& view) {
  const Extent extent = view.extent();
  const PixelBox limit{{-extent.width, -extent.height}, {2 * extent.width, 2 * extent.height}};
  for (const std::uint32_t f : changes.gone) {
    const FaceImage face(before.mesh.triangles[f], before.image);
    if (!face.is_visible()) continue;
    const double side = view.pixel_size(face.depths[0]);
    const double slope = slope_of(face, side);
    const double tolerance = kDepthTolerance * side * std::sqrt(1.0 + slope * slope);
    face.for_each_pixel(limit, [&](Pixel pixel, double depth) {
      places_.push_back({pixel, depth, tolerance});
    });
  }
}

void LostPixels::cover_by(std::span<const Triangle> faces, const ImagePlane& image) {
  if (places_.empty()) return;
  PixelBox box;
  for (const Place& place : places_)
    box.add(place.pixel);
  Grid<Depths> depths(box.extent());
  for (const Triangle& triangle : faces) {
    const FaceImage face(triangle, image);
    if (!face.is_visible()) continue;
    face.for_each_pixel(box, [&](Pixel pixel, double depth) {
      Depths& here = depths[box.local(pixel)];
      here.nearest = std::min(here.nearest, depth);
      here.farthest = std::max(here.farthest, depth);
    });
  }
  std::erase_if(places_, [&](const Place& place) {
    const Depths& here = depths[box.local(place.pixel)];
    return std::abs(here.nearest - place.depth) <= place.tolerance ||
           std::abs(here.farthest - place.depth) <= place.tolerance;
  });
}

std::vector<Pixel> LostPixels::pixels() const {
  std::vector<Pixel> pixels;
  for (const Place& place : places_)
    pixels.push_back(place.pixel);
  const auto comes_first = [](Pixel a, Pixel b) { return a.y != b.y ? a.y < b.y : a.x < b.x; };
  std::sort(pixels.begin(), pixels.end(), comes_first);
  pixels.erase(std::unique(pixels.begin(), pixels.end()), pixels.end());
  return pixels;
}

}  // namespace

std::vector<Pixel> find_lost_pixels(const SeenMesh& before, const SeenMesh& after,
                                    const FaceChanges& changes, const View& view) {
  LostPixels lost(before, changes, view);
  std::vector<Triangle> made;
  for (const std::uint32_t f : changes.made)
    made.push_back(after.mesh.triangles[f]);
  // Those cover nearly all; what stayed may lie under what is gone, where the surface folds.
  lost.cover_by(made, after.image);
  lost.cover_by(after.mesh.triangles, after.image);
  return lost.pixels();
}

}  // namespace rangezip
