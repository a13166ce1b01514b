#include "core/raster/split_triangle.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

namespace rangezip {

namespace {

/// A corner of the polygon that is left of the triangle.
struct PolygonCorner {
  Vec3 position{0.0};                      ///< in the item's own space
  std::optional<SnappedPosition> snapped;  ///< set if R3 or R4 accepts it: then it is inside of
                                           ///< the guard range, whatever rounding says below
  std::optional<std::size_t> original;     ///< index among the triangle's corners
};

using Polygon = std::vector<PolygonCorner>;

double product(const Row& row, const Vec3& p) {
  return ((row[0] * p.x + row[1] * p.y) + row[2] * p.z) + row[3];
}

/// The point of the edge where `value` passes through 0. Always taken from the inside to the
/// outside, so that both neighbours of the edge compute the same bits.
PolygonCorner cut(const PolygonCorner& inside, const PolygonCorner& outside, double inside_value,
                  double outside_value) {
  const double t = inside_value / (inside_value - outside_value);
  return {.position = inside.position + t * (outside.position - inside.position)};
}

/// The part of the polygon where value(corner) >= 0 [Sutherland, Hodgman 1974].
template <class Value>
void keep_inside(Polygon& polygon, const Value& value) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const PolygonCorner& from = polygon[i];
    const PolygonCorner& to = polygon[(i + 1) % polygon.size()];
    const double from_value = value(from);
    const double to_value = value(to);
    if (from_value >= 0.0) kept.push_back(from);
    if (from_value >= 0.0 && to_value < 0.0) kept.push_back(cut(from, to, from_value, to_value));
    if (from_value < 0.0 && to_value >= 0.0) kept.push_back(cut(to, from, to_value, from_value));
  }
  polygon = std::move(kept);
}

void keep_inside_clip_plane(Polygon& polygon, const Row& plane,
                            const std::array<Vec3f, 3>& corners) {
  keep_inside(polygon, [&](const PolygonCorner& corner) -> double {
    // A corner of the triangle is judged as R11 judges a point.
    if (corner.original) return row_product(plane, corners[*corner.original]);
    return product(plane, corner.position);
  });
}

/// Cuts by sign * row <= limit * w, w = 1 under a parallel projection.
void keep_inside_guard(Polygon& polygon, const RowTransform& rows, const Row& row, double sign,
                       double limit) {
  keep_inside(polygon, [&](const PolygonCorner& corner) -> double {
    const double w = rows.is_central ? product(rows.w, corner.position) : 1.0;
    const double value = limit * w - sign * product(row, corner.position);
    return corner.snapped ? std::max(value, 0.0) : value;
  });
}

void keep_inside_guard_range(Polygon& polygon, const RowTransform& rows) {
  if (rows.is_central) {
    keep_inside(polygon, [&](const PolygonCorner& corner) -> double {
      constexpr double kLeastW = 0x1p-64;
      const double value = product(rows.w, corner.position) - kLeastW;
      return corner.snapped ? std::max(value, 0.0) : value;
    });
    keep_inside(polygon, [&](const PolygonCorner& corner) -> double {
      constexpr double kGreatestW = 0x1p64;
      const double value = kGreatestW - product(rows.w, corner.position);
      return corner.snapped ? std::max(value, 0.0) : value;
    });
  }
  for (const double sign : {1.0, -1.0}) {
    keep_inside_guard(polygon, rows, rows.z, sign, kGuardZ);
    keep_inside_guard(polygon, rows, rows.x, sign, kGuardXY);
    keep_inside_guard(polygon, rows, rows.y, sign, kGuardXY);
  }
}

/// Nearest integer in [-limit, limit]; the cuts leave at most a rounding error outside of it.
std::int32_t to_grid(double value, std::int32_t limit) {
  if (!(value > -limit)) return -limit;
  if (!(value < limit)) return limit;
  return static_cast<std::int32_t>(std::floor(value + 0.5));
}

SnappedPosition snap(const PolygonCorner& corner, const RowTransform& rows) {
  if (corner.snapped) return *corner.snapped;
  const double w = rows.is_central ? product(rows.w, corner.position) : 1.0;
  return {to_grid(product(rows.x, corner.position) / w, kGuardXY),
          to_grid(product(rows.y, corner.position) / w, kGuardXY),
          to_grid(product(rows.z, corner.position) / w, kGuardZ)};
}

bool is_finite(const Vec3f& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

Polygon polygon_of(const RowTransform& rows, const std::array<Vec3f, 3>& corners) {
  std::array<SnappedPosition, 3> snapped;
  snap_positions(rows, corners, snapped);
  Polygon polygon;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    PolygonCorner corner{.position = Vec3(corners[i]), .original = i};
    if (!is_rejected(snapped[i])) corner.snapped = snapped[i];
    polygon.push_back(corner);
  }
  return polygon;
}

}  // namespace

bool split_triangle(const RowTransform& rows, const std::array<Vec3f, 3>& corners,
                    std::vector<SnappedTriangle>& pieces) {
  if (!std::all_of(corners.begin(), corners.end(), is_finite)) return false;
  Polygon polygon = polygon_of(rows, corners);
  for (const Row& plane : rows.clip)
    keep_inside_clip_plane(polygon, plane, corners);
  keep_inside_guard_range(polygon, rows);
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    pieces.push_back({snap(polygon[0], rows), snap(polygon[i - 1], rows), snap(polygon[i], rows)});
  }
  return true;
}

}  // namespace rangezip
