#include "raster_gl/plain_drawing.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "core/raster/split_triangle.h"

namespace rangezip::plain {

namespace {

constexpr int kPixel = 256;

/// The grid position of a pixel's centre along one axis.
constexpr int center_of(int pixel) {
  return kPixel * pixel + kPixel / 2;
}

std::vector<SnappedPosition> snap(const RowTransform& rows, std::span<const Vec3f> positions) {
  std::vector<SnappedPosition> snapped(positions.size());
  snap_positions(rows, positions, snapped);
  reject_clipped(rows, positions, snapped);
  return snapped;
}

class Painter {
 public:
  Painter(Framebuffer& image, const DepthBand* band) : image_(image), band_(band) {}

  void point(const SnappedPosition& p, int size, PrimitiveId id) {
    const int left = (p.x - kPixel / 2 * (size - 1)) >> 8;
    const int bottom = (p.y - kPixel / 2 * (size - 1)) >> 8;
    for (int y = bottom; y < bottom + size; ++y) {
      for (int x = left; x < left + size; ++x)
        plot({x, y}, p.z, id);
    }
  }

  void triangle(SnappedTriangle t, Facing facing, PrimitiveId id) {
    const std::int64_t area = edge(t[0], t[1], t[2].x, t[2].y);
    if (area == 0 || (facing == Facing::front && area < 0)) return;
    if (facing == Facing::back && area > 0) return;
    if (area < 0) std::swap(t[1], t[2]);
    const Extent extent = image_.depth.extent();
    for (int y = 0; y < extent.height; ++y) {
      for (int x = 0; x < extent.width; ++x)
        fragment(t, std::abs(area), {x, y}, id);
    }
  }

 private:
  static std::int64_t edge(const SnappedPosition& from, const SnappedPosition& to, int x, int y) {
    return std::int64_t{to.x - from.x} * (y - from.y) - std::int64_t{to.y - from.y} * (x - from.x);
  }

  void fragment(const SnappedTriangle& t, std::int64_t area, Pixel at, PrimitiveId id) {
    const int z_min = std::min({t[0].z, t[1].z, t[2].z});
    std::int64_t numerator = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const SnappedPosition& from = t[(i + 1) % 3];
      const SnappedPosition& to = t[(i + 2) % 3];
      const std::int64_t e = edge(from, to, center_of(at.x), center_of(at.y));
      const bool owns_ties = to.y < from.y || (to.y == from.y && to.x > from.x);
      if (e < 0 || (e == 0 && !owns_ties)) return;
      numerator += e * (t[i].z - z_min);
    }
    plot(at, z_min + static_cast<int>(numerator / area), id);
  }

  void plot(Pixel at, int depth, PrimitiveId id) {
    if (!image_.depth.extent().contains(at)) return;
    if (depth < 0 || depth > static_cast<int>(kMaxDepth)) return;
    if (band_ != nullptr && (depth < band_->lower[at] || depth > band_->upper[at])) return;
    const auto key = std::pair(static_cast<std::uint32_t>(depth), id);
    if (key < std::pair(image_.depth[at], image_.id[at]))
      std::tie(image_.depth[at], image_.id[at]) = key;
  }

  Framebuffer& image_;
  const DepthBand* band_;
};

void draw_points(const View& view, const DrawPoints& points, Painter& painter) {
  const RowTransform rows = make_row_transform(view, points.world_from_item);
  PrimitiveId id = points.first_id;
  for (const SnappedPosition& p : snap(rows, points.positions)) {
    if (!is_rejected(p)) painter.point(p, points.point_size, id);
    ++id;
  }
}

void draw_triangles(const View& view, const DrawTriangles& item, Painter& painter) {
  const RowTransform rows = make_row_transform(view, item.world_from_item);
  const std::vector<SnappedPosition> snapped = snap(rows, item.positions);
  PrimitiveId id = item.first_id;
  for (const auto& [a, b, c] : item.triangles) {
    std::vector<SnappedTriangle> pieces{{snapped[a], snapped[b], snapped[c]}};
    if (std::any_of(pieces[0].begin(), pieces[0].end(), is_rejected)) {
      pieces.clear();
      // One that is not finite has no pieces.
      static_cast<void>(
          split_triangle(rows, {item.positions[a], item.positions[b], item.positions[c]}, pieces));
    }
    for (const SnappedTriangle& piece : pieces)
      painter.triangle(piece, item.facing, id);
    ++id;
  }
}

void add_term(PixelMoments& sums, std::int64_t dx, std::int64_t dy, std::int64_t z, int vote) {
  const std::int64_t w = (kPixel - std::abs(dx)) * (kPixel - std::abs(dy));
  sums.w += w;
  sums.w_dx += w * dx;
  sums.w_dy += w * dy;
  sums.w_dx_dx += w * dx * dx;
  sums.w_dx_dy += w * dx * dy;
  sums.w_dy_dy += w * dy * dy;
  sums.w_z += w * z;
  sums.w_z_dx += w * z * dx;
  sums.w_z_dy += w * z * dy;
  sums.w_vote += w * vote;
}

void sum_point(const SnappedPosition& p, int vote, const AccumulateWindow& window,
               Grid<PixelMoments>& sums) {
  if (is_rejected(p) || p.z < 0 || p.z > static_cast<int>(kMaxDepth)) return;
  const Extent extent = sums.extent();
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) {
      const Pixel at{x, y};
      const int dx = p.x - center_of(x);
      const int dy = p.y - center_of(y);
      if (std::abs(dx) >= kPixel || std::abs(dy) >= kPixel) continue;
      if (p.z < window.band.lower[at] || p.z > window.band.upper[at]) continue;
      add_term(sums[at], dx, dy, (p.z - window.reference[at]) >> window.shift, vote);
    }
  }
}

}  // namespace

Framebuffer draw(const View& view, std::span<const DrawItem> items, const DepthBand* band) {
  Framebuffer image = make_framebuffer(view.extent());
  Painter painter(image, band);
  for (const DrawItem& item : items) {
    if (const auto* points = std::get_if<DrawPoints>(&item)) {
      draw_points(view, *points, painter);
    } else {
      draw_triangles(view, std::get<DrawTriangles>(item), painter);
    }
  }
  return image;
}

Grid<PixelMoments> sum(const View& view, std::span<const DrawItem> items,
                       const AccumulateWindow& window) {
  Grid<PixelMoments> sums(view.extent());
  for (const DrawItem& item : items) {
    const auto* points = std::get_if<DrawPoints>(&item);
    if (points == nullptr) continue;
    const RowTransform rows = make_row_transform(view, points->world_from_item);
    const std::vector<SnappedPosition> snapped = snap(rows, points->positions);
    for (std::size_t i = 0; i < snapped.size(); ++i)
      sum_point(snapped[i], points->votes.empty() ? 0 : points->votes[i], window, sums);
  }
  return sums;
}

}  // namespace rangezip::plain
