#include "compare/footprint.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>
#include <variant>

#include "core/base/error.h"

namespace rangezip::compare {

namespace {

__extension__ using Wide = __int128;

constexpr int kSubpixelBits = 8;
constexpr std::int64_t kSubpixels = 1 << kSubpixelBits;
constexpr std::int64_t kHalfPixel = kSubpixels / 2;

/// A place in the window, 1/256 px.
struct Place {
  std::int64_t x = 0;
  std::int64_t y = 0;
};

Place center_of(Pixel pixel) {
  return {kSubpixels * pixel.x + kHalfPixel, kSubpixels * pixel.y + kHalfPixel};
}

/// R6's E for the edge from `from` to `to`: twice the area of (from, to, s).
struct Edge {
  std::int64_t dx = 0;
  std::int64_t dy = 0;
  Place from;

  Edge(const SnappedPosition& p, const SnappedPosition& q)
      : dx(std::int64_t{q.x} - p.x), dy(std::int64_t{q.y} - p.y), from{p.x, p.y} {}

  [[nodiscard]] std::int64_t at(const Place& s) const {
    return dx * (s.y - from.y) - dy * (s.x - from.x);
  }
  /// By how much E changes at most over a square of this half side.
  [[nodiscard]] std::int64_t reach(std::int64_t half_side) const {
    return half_side * (std::abs(dx) + std::abs(dy));
  }
  [[nodiscard]] bool owns_ties() const { return dy < 0 || (dy == 0 && dx > 0); }
};

/// A triangle turned counter-clockwise; `area` is that of R6 before.
struct Turned {
  std::int64_t area = 0;
  std::array<SnappedPosition, 3> corners;
  std::array<Edge, 3> edges;  ///< opposite to the corners

  explicit Turned(const SnappedTriangle& t)
      : area(Edge(t[0], t[1]).at({t[2].x, t[2].y})),
        corners(area < 0 ? SnappedTriangle{t[0], t[2], t[1]} : t),
        edges{Edge(corners[1], corners[2]), Edge(corners[2], corners[0]),
              Edge(corners[0], corners[1])} {}
};

/// Whether the triangle has an area and faces the right way after its area has changed by `change`.
bool is_drawn(std::int64_t area, std::int64_t change, Facing facing) {
  if (facing == Facing::front) return area + change > 0;
  if (facing == Facing::back) return area - change < 0;
  return area != 0 || change > 0;
}

/// By how much the doubled area changes at most if each corner moves by `edge` in x and in y.
std::int64_t area_change(const Turned& t, std::int64_t edge) {
  return t.edges[1].reach(2 * edge) + t.edges[2].reach(2 * edge) + 8 * edge * edge;
}

bool covers(const Turned& t, const Place& s) {  // R6
  return std::all_of(t.edges.begin(), t.edges.end(), [&](const Edge& edge) {
    const std::int64_t value = edge.at(s);
    return value > 0 || (value == 0 && edge.owns_ties());
  });
}

/// Whether `s` lies in the sum of the triangle and the square: within its moved edges and its box.
bool is_near(const Turned& t, const Place& s, std::int64_t half_side) {
  const auto [x_min, x_max] = std::minmax({t.corners[0].x, t.corners[1].x, t.corners[2].x});
  const auto [y_min, y_max] = std::minmax({t.corners[0].y, t.corners[1].y, t.corners[2].y});
  return s.x >= x_min - half_side && s.x <= x_max + half_side && s.y >= y_min - half_side &&
         s.y <= y_max + half_side &&
         std::all_of(t.edges.begin(), t.edges.end(),
                     [&](const Edge& edge) { return edge.at(s) >= -edge.reach(half_side); });
}

bool may_cover(const Turned& t, const Place& s, Facing facing, std::int64_t edge) {
  if (!is_drawn(t.area, area_change(t, edge), facing)) return false;
  return edge == 0 ? covers(t, s) : is_near(t, s, edge);
}

bool must_cover(const Turned& t, const Place& s, Facing facing, std::int64_t edge) {
  return is_drawn(t.area, -area_change(t, edge), facing) && covers(t, s);
}

/// Rounded down; `divisor` > 0.
std::int64_t floor_of(Wide dividend, Wide divisor) {
  const Wide quotient = dividend / divisor;
  return static_cast<std::int64_t>(dividend % divisor < 0 ? quotient - 1 : quotient);
}

struct DepthRange {
  std::int64_t nearest = 0;
  std::int64_t farthest = 0;
};
constexpr DepthRange kAnyDepth{-std::int64_t{kMaxDepth}, 2 * std::int64_t{kMaxDepth}};

/// Depths that a piece of a triangle may have at `s`: R7, and what the tolerance adds. Corners that
/// move tilt the plane, the more so the thinner the triangle; one that they may turn over has no
/// plane to speak of.
DepthRange depths_of(const Turned& t, const Place& s, const DrawingTolerance& tolerance) {
  const auto [z_min, z_max] = std::minmax({t.corners[0].z, t.corners[1].z, t.corners[2].z});
  const Wide area = std::abs(t.area);
  const Wide least_area = area - area_change(t, tolerance.slope);
  if (least_area <= 0) return kAnyDepth;
  Wide height = 0;  // each times the area
  Wide rise_x = 0;
  Wide rise_y = 0;
  Wide tilt = 0;  // by how much both rises together change at most
  for (std::size_t i = 0; i < t.edges.size(); ++i) {
    const Wide z = std::int64_t{t.corners[i].z} - z_min;
    height += z * t.edges[i].at(s);
    rise_x -= z * t.edges[i].dy;
    rise_y += z * t.edges[i].dx;
    tilt += z * 4 * tolerance.slope;
  }
  const Wide rise = (rise_x < 0 ? -rise_x : rise_x) + (rise_y < 0 ? -rise_y : rise_y) + tilt;
  const std::int64_t depth = z_min + floor_of(height, area);
  const std::int64_t allowance =
      tolerance.depth - floor_of(-rise * tolerance.slope, least_area);  // rounded up
  return {std::max<std::int64_t>(depth, z_min) - allowance,
          std::min<std::int64_t>(depth, z_max) + allowance};
}

/// The pieces of a triangle make up a convex polygon, so it holds a square if it holds its corners.
bool holds_square(const std::vector<SnappedTriangle>& pieces, Facing facing, const Place& center,
                  std::int64_t half_side) {
  for (const std::int64_t dx : {-half_side, half_side}) {
    for (const std::int64_t dy : {-half_side, half_side}) {
      const Place corner{center.x + dx, center.y + dy};
      if (std::none_of(pieces.begin(), pieces.end(), [&](const SnappedTriangle& piece) {
            return must_cover(Turned(piece), corner, facing, half_side);
          })) {
        return false;
      }
    }
  }
  return true;
}

PixelFit fit_of_triangle(const SnappedPrimitive& triangle, Pixel pixel,
                         const DrawingTolerance& tolerance) {
  const Place center = center_of(pixel);
  PixelFit fit;
  for (const SnappedTriangle& piece : triangle.pieces) {
    const Turned turned(piece);
    if (!may_cover(turned, center, triangle.facing, tolerance.edge)) continue;
    const DepthRange depths = depths_of(turned, center, tolerance);
    fit.nearest = fit.may_cover ? std::min(fit.nearest, depths.nearest) : depths.nearest;
    fit.farthest = fit.may_cover ? std::max(fit.farthest, depths.farthest) : depths.farthest;
    fit.may_cover = true;
  }
  fit.must_cover =
      fit.may_cover && holds_square(triangle.pieces, triangle.facing, center, tolerance.edge);
  return fit;
}

/// R5 along one axis: the first of the pixels that a point of this size covers.
std::int64_t first_covered(std::int64_t center, int size) {
  return (center - kHalfPixel * (size - 1)) >> kSubpixelBits;
}

bool may_cover(std::int64_t center, int size, int pixel, std::int64_t edge) {
  return pixel >= first_covered(center - edge, size) &&
         pixel < first_covered(center + edge, size) + size;
}

bool must_cover(std::int64_t center, int size, int pixel, std::int64_t edge) {
  return pixel >= first_covered(center + edge, size) &&
         pixel < first_covered(center - edge, size) + size;
}

PixelFit fit_of_point(const SnappedPrimitive& primitive, Pixel pixel,
                      const DrawingTolerance& tolerance) {
  const SnappedPosition& p = primitive.point;
  const int size = primitive.point_size;
  if (is_rejected(p)) return {};
  return {.may_cover = may_cover(p.x, size, pixel.x, tolerance.edge) &&
                       may_cover(p.y, size, pixel.y, tolerance.edge),
          .must_cover = must_cover(p.x, size, pixel.x, tolerance.edge) &&
                        must_cover(p.y, size, pixel.y, tolerance.edge),
          .nearest = p.z - tolerance.depth,
          .farthest = p.z + tolerance.depth};
}

void include(std::int64_t x, std::int64_t y, Place& lower, Place& upper) {
  lower = {std::min(lower.x, x), std::min(lower.y, y)};
  upper = {std::max(upper.x, x), std::max(upper.y, y)};
}

}  // namespace

DrawingTolerance driver_tolerance(int subpixel_bits) {
  constexpr int kMostBits = 16;
  if (subpixel_bits < 1 || subpixel_bits > kMostBits) {
    throw InvalidArgument("driver_tolerance: subpixel_bits must lie in 1..16, got " +
                          std::to_string(subpixel_bits));
  }
  constexpr int kFloats = 2;
  constexpr std::int64_t kDepth = 16;
  const int step = std::max(1, static_cast<int>(kSubpixels) >> subpixel_bits);
  return {.edge = step + kFloats, .slope = step + kFloats, .depth = kDepth};
}

SnappedItem snap_item(const View& view, const DrawItem& item) {
  SnappedItem snapped{.item = &item};
  std::visit(
      [&](const auto& drawn) {
        snapped.rows = make_row_transform(view, drawn.world_from_item);
        snapped.positions.resize(drawn.positions.size());
        snap_positions(snapped.rows, drawn.positions, snapped.positions);
        reject_clipped(snapped.rows, drawn.positions, snapped.positions);
      },
      item);
  return snapped;
}

void get_primitive(const SnappedItem& item, std::size_t index, SnappedPrimitive& primitive) {
  primitive.id = first_id(*item.item) + static_cast<PrimitiveId>(index);
  primitive.pieces.clear();
  if (const auto* points = std::get_if<DrawPoints>(item.item)) {
    primitive.point_size = points->point_size;
    primitive.point = item.positions[index];
    return;
  }
  const auto& triangles = std::get<DrawTriangles>(*item.item);
  const auto& [a, b, c] = triangles.triangles[index];
  primitive.point_size = 0;
  primitive.facing = triangles.facing;
  const SnappedTriangle whole{item.positions[a], item.positions[b], item.positions[c]};
  if (std::none_of(whole.begin(), whole.end(), is_rejected)) {
    primitive.pieces.push_back(whole);
    return;
  }
  const auto& p = triangles.positions;
  // What is not finite has no piece.
  static_cast<void>(split_triangle(item.rows, {p[a], p[b], p[c]}, primitive.pieces));
}

PixelBox reach_of(const SnappedPrimitive& primitive, const DrawingTolerance& tolerance,
                  Extent extent) {
  constexpr std::int64_t kFar = std::int64_t{1} << 40U;
  Place lower{kFar, kFar};
  Place upper{-kFar, -kFar};
  if (primitive.point_size > 0 && !is_rejected(primitive.point)) {
    const std::int64_t half = kHalfPixel * primitive.point_size;
    include(primitive.point.x - half, primitive.point.y - half, lower, upper);
    include(primitive.point.x + half, primitive.point.y + half, lower, upper);
  }
  for (const SnappedTriangle& piece : primitive.pieces) {
    for (const SnappedPosition& corner : piece)
      include(corner.x, corner.y, lower, upper);
  }
  const auto pixel = [](std::int64_t place) { return place >> kSubpixelBits; };
  const auto on_screen = [](std::int64_t p, int size) {
    return static_cast<int>(std::clamp<std::int64_t>(p, -1, size));
  };
  const int edge = tolerance.edge;
  return {{std::max(0, on_screen(pixel(lower.x - edge), extent.width)),
           std::max(0, on_screen(pixel(lower.y - edge), extent.height))},
          {std::min(extent.width - 1, on_screen(pixel(upper.x + edge), extent.width)),
           std::min(extent.height - 1, on_screen(pixel(upper.y + edge), extent.height))}};
}

PixelFit fit_of(const SnappedPrimitive& primitive, Pixel pixel, const DrawingTolerance& tolerance) {
  return primitive.point_size > 0 ? fit_of_point(primitive, pixel, tolerance)
                                  : fit_of_triangle(primitive, pixel, tolerance);
}

}  // namespace rangezip::compare
