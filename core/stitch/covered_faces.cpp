#include "core/stitch/covered_faces.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/parallel.h"

namespace rangezip {

namespace {

constexpr std::size_t kItemsPerBlock = 4096;

/// A face that looks away counts as seen on edge up to 10 degrees: sin 10.
constexpr double kOnEdgeCosine = 0.17;

/// One face in the image, in pixels (see in_pixels).
struct FaceImage {
  std::array<Vec2, 3> corners;
  double nearest = 0.0;
  double farthest = 0.0;
  Vec2 gradient{0.0, 0.0};  ///< of the depth, per pixel

  [[nodiscard]] double depth_at(const Vec2& place, double depth_of_first) const {
    const Vec2 offset = place - corners[0];
    const double depth = depth_of_first + glm::dot(gradient, offset);
    return std::clamp(depth, nearest, farthest);
  }
};

FaceImage image_of_face(const Triangle& face, const ImagePlane& image) {
  FaceImage result;
  std::array<double, 3> z{};
  for (std::size_t k = 0; k < 3; ++k) {
    result.corners[k] = in_pixels(image.points[face[k]]);
    z[k] = image.depths[face[k]];
  }
  result.nearest = std::min({z[0], z[1], z[2]});
  result.farthest = std::max({z[0], z[1], z[2]});
  const Vec2 u = result.corners[1] - result.corners[0];
  const Vec2 v = result.corners[2] - result.corners[0];
  const double area = u.x * v.y - u.y * v.x;
  constexpr double kFlat = 1e-6;  // square pixels; below, the corners' depths are all there is
  if (std::abs(area) > kFlat) {
    const double du = z[1] - z[0];
    const double dv = z[2] - z[0];
    result.gradient = Vec2{du * v.y - dv * u.y, dv * u.x - du * v.x} / area;
  }
  return result;
}

/// Range of x that the face takes between the heights y and y + 1; empty if first > last.
struct Span {
  double first = std::numeric_limits<double>::infinity();
  double last = -std::numeric_limits<double>::infinity();
  void add(double x) {
    first = std::min(first, x);
    last = std::max(last, x);
  }
};

Span span_in_row(const std::array<Vec2, 3>& corners, int row) {
  Span span;
  const double bottom = row;
  const double top = row + 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2& p = corners[k];
    const Vec2& q = corners[(k + 1) % 3];
    if (p.y >= bottom && p.y <= top) span.add(p.x);
    for (const double y : {bottom, top}) {
      if ((p.y < y) != (q.y < y)) span.add(p.x + (q.x - p.x) * (y - p.y) / (q.y - p.y));
    }
  }
  return span;
}

struct Finder {
  const TriangleMesh& mesh;
  const ImagePlane& image;
  const PatchSheet& sheet;
  const CoveredFacesOptions& options;

  [[nodiscard]] bool looks_at_viewer(const Triangle& face) const {
    return orientation(image.points[face[0]], image.points[face[1]], image.points[face[2]]) > 0;
  }

  [[nodiscard]] bool is_back_face(const Triangle& face) const {
    const Vec3& a = mesh.positions[face[0]];
    const Vec3 normal = area_vector(a, mesh.positions[face[1]], mesh.positions[face[2]]);
    const double toward = glm::dot(normal, sheet.image().view().toward_viewer(a));
    return toward < -kOnEdgeCosine * glm::length(normal);
  }

  /// Rows and columns of cells that both the face and the patch touch.
  struct CellBox {
    Pixel first, last;
    [[nodiscard]] bool is_empty() const { return first.x > last.x || first.y > last.y; }
  };

  [[nodiscard]] CellBox shared_cells(const Triangle& face) const {
    const GridPoint& a = image.points[face[0]];
    const GridPoint& b = image.points[face[1]];
    const GridPoint& c = image.points[face[2]];
    const auto cell_of = [](std::int64_t x) { return static_cast<int>(x >> kGridBits); };
    const Pixel first = sheet.first_pixel();
    const Pixel last = sheet.last_pixel();
    return {{std::max(first.x, cell_of(std::min({a.x, b.x, c.x}))),
             std::max(first.y, cell_of(std::min({a.y, b.y, c.y})))},
            {std::min(last.x - 1, cell_of(std::max({a.x, b.x, c.x}))),
             std::min(last.y - 1, cell_of(std::max({a.y, b.y, c.y})))}};
  }

  [[nodiscard]] bool overlaps_patch(const Triangle& face) const {
    for (const std::uint32_t corner : face) {
      if (!image.has_image(corner)) return false;
    }
    const CellBox box = shared_cells(face);
    if (box.is_empty()) return false;
    if (!looks_at_viewer(face) && is_back_face(face)) return false;

    const FaceImage shape = image_of_face(face, image);
    constexpr double kRounding = 1.0 / static_cast<double>(kGridStep);
    for (int y = box.first.y; y <= box.last.y; ++y) {
      const Span span = span_in_row(shape.corners, y);
      if (span.first > span.last) continue;
      const int first = std::max(box.first.x, static_cast<int>(std::floor(span.first - kRounding)));
      const int last = std::min(box.last.x, static_cast<int>(std::floor(span.last + kRounding)));
      for (int x = first; x <= last; ++x) {
        if (!sheet.has_cell({x, y})) continue;
        const double depth = shape.depth_at({x + 0.5, y + 0.5}, image.depths[face[0]]);
        if (sheet.is_in_band({x, y}, depth, options.band)) return true;
      }
    }
    return false;
  }

  /// Whether the vertex lies on the sheet and closer to a cell of the patch than the clearance.
  [[nodiscard]] bool is_too_close(std::uint32_t vertex) const {
    const GridPoint& point = image.points[vertex];
    if (!image.has_image(vertex)) return false;
    const Pixel cell{static_cast<int>(point.x >> kGridBits),
                     static_cast<int>(point.y >> kGridBits)};
    const Pixel first = sheet.first_pixel();
    const Pixel last = sheet.last_pixel();
    if (cell.x < first.x - 1 || cell.y < first.y - 1 || cell.x > last.x || cell.y > last.y) {
      return false;
    }
    const Vec2 place = in_pixels(point);
    bool is_near = false;
    for (int k = 0; k < 9 && !is_near; ++k) {
      const Pixel other{cell.x + k % 3 - 1, cell.y + k / 3 - 1};
      if (!sheet.has_cell(other)) continue;
      const double dx = std::max({0.0, other.x - place.x, place.x - (other.x + 1)});
      const double dy = std::max({0.0, other.y - place.y, place.y - (other.y + 1)});
      is_near = dx * dx + dy * dy < options.clearance * options.clearance;
    }
    if (!is_near) return false;
    const SheetSample& sample = sheet[nearest_pixel(point)];
    if (sample.ring == SheetSample::kUnknown) return false;
    const double deviation = std::abs(image.depths[vertex] - sample.depth);
    return deviation <= sheet.tolerance(sample.stretch, sample.depth, options.band);
  }
};

}  // namespace

std::vector<std::uint8_t> find_covered_faces(const TriangleMesh& mesh, const ImagePlane& image,
                                             const PatchSheet& sheet,
                                             const CoveredFacesOptions& options) {
  const Finder finder{mesh, image, sheet, options};
  std::vector<std::uint8_t> too_close(mesh.positions.size(), 0);
  if (options.clearance > 0.0) {
    parallel_for(too_close.size(), kItemsPerBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        too_close[v] = finder.is_too_close(static_cast<std::uint32_t>(v)) ? 1 : 0;
      }
    });
  }
  std::vector<std::uint8_t> covered(mesh.triangles.size(), 0);
  parallel_for(covered.size(), kItemsPerBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      const Triangle& face = mesh.triangles[f];
      const bool is_close =
          std::any_of(face.begin(), face.end(), [&](std::uint32_t v) { return too_close[v] != 0; });
      covered[f] =
          (is_close && finder.looks_at_viewer(face)) || finder.overlaps_patch(face) ? 1 : 0;
    }
  });
  return covered;
}

}  // namespace rangezip
