#include "core/plan/line_gap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "core/base/quantile.h"
#include "core/base/symmetric_eigen.h"
#include "core/plan/own_sheet.h"
#include "core/plan/slab_index.h"

namespace rangezip {
namespace {

/// Three quarters of the places have less on a surface: 2.24 on a square grid, 2.4 at random.
constexpr double kRadii = 2.5;

/// In radii of 16 points: the ball that is looked at; of it the part that tells the tangent plane,
/// and over which locations are spread; and how far from that plane points may lie.
constexpr double kBall = 4.0;
constexpr double kDisc = 2.0;
constexpr double kSlab = 1.0;
constexpr int kLocationsAcross = 9;
/// Of about sixty.
constexpr std::size_t kLeastLocations = 12;

/// How much larger holes are than those of as many points at random, where there are lines; these
/// themselves, and grids, have less than 1.05.
constexpr double kOpen = 1.25;
constexpr double kShareOfPlaces = 0.8;

/// Places that have 16 points around them, in the order of x.
std::vector<LinePlace> told_places(std::span<const LinePlace> places) {
  std::vector<LinePlace> told;
  for (const LinePlace& place : places) {
    if (place.radius_of_16 > 0.0 && place.radius_of_4 > 0.0) told.push_back(place);
  }
  std::stable_sort(told.begin(), told.end(),
                   [](const LinePlace& a, const LinePlace& b) { return a.center.x < b.center.x; });
  return told;
}

bool may_have_lines(std::span<const LinePlace> places) {
  std::vector<double> ratios;
  ratios.reserve(places.size());
  for (const LinePlace& place : places)
    ratios.push_back(place.radius_of_16 / place.radius_of_4);
  return !ratios.empty() && quantile(std::move(ratios), 0.75) >= kRadii;
}

/// The points around a place in coordinates of its tangent plane.
std::vector<Vec2> in_tangent_plane(const std::vector<Vec3>& offsets, double radius) {
  std::vector<Vec3> near{Vec3(0.0)};
  for (const Vec3& offset : offsets) {
    if (glm::length(offset) <= kDisc * radius) near.push_back(offset);
  }
  const SymmetricEigen eigen = eigen_of_symmetric(scatter_of(near));
  std::vector<Vec2> flat;
  for (const Vec3& offset : offsets) {
    if (std::abs(glm::dot(offset, eigen.vectors[0])) > kSlab * radius) continue;
    flat.emplace_back(glm::dot(offset, eigen.vectors[1]), glm::dot(offset, eigen.vectors[2]));
  }
  return flat;
}

/// The squared distance of a location from the nearest of the points; nothing if it may lie beyond
/// a border: in one of the quadrants around it, as far as `reach`, is no point.
std::optional<double> hole_at(const Vec2& location, const std::vector<Vec2>& points, double reach) {
  std::array<bool, 4> has_points{};
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vec2& point : points) {
    const Vec2 offset = point - location;
    const double squared = glm::dot(offset, offset);
    if (squared > reach * reach) continue;
    has_points[(offset.x > 0.0 ? 1U : 0U) + (offset.y > 0.0 ? 2U : 0U)] = true;
    nearest = std::min(nearest, squared);
  }
  const bool is_inside =
      std::all_of(has_points.begin(), has_points.end(), [](bool b) { return b; });
  return is_inside ? std::optional(nearest) : std::nullopt;
}

/// Root mean square of the distances of locations around a place from the nearest point.
std::optional<double> hole_around(const std::vector<Vec3>& offsets, double radius) {
  const std::vector<Vec2> flat = in_tangent_plane(offsets, radius);
  const double reach = kDisc * radius, step = 2.0 * reach / (kLocationsAcross - 1);
  double sum = 0.0;
  std::size_t count = 0;
  for (int row = 0; row < kLocationsAcross; ++row) {
    for (int column = 0; column < kLocationsAcross; ++column) {
      const double x = column * step - reach, y = row * step - reach;
      const Vec2 location{0.8 * x - 0.6 * y, 0.6 * x + 0.8 * y};  // in no row along the lines
      if (glm::length(location) > reach) continue;
      const std::optional<double> hole = hole_at(location, flat, reach);
      if (!hole) continue;
      sum += *hole;
      ++count;
    }
  }
  if (count < kLeastLocations) return std::nullopt;
  return std::sqrt(sum / static_cast<double>(count));
}

}  // namespace

double line_gap(std::span<const Vec3> points, std::span<const LinePlace> places) {
  const std::vector<LinePlace> told = told_places(places);
  if (!may_have_lines(told)) return 0.0;
  std::vector<SlabIndex::Ball> balls;
  balls.reserve(told.size());
  for (const LinePlace& place : told)
    balls.push_back({place.center, kBall * place.radius_of_16});
  const std::vector<std::vector<Vec3>> around = offsets_in_balls(balls, points);

  std::vector<double> holes, ratios;
  for (std::size_t i = 0; i < told.size(); ++i) {
    const std::optional<double> hole = hole_around(around[i], told[i].radius_of_16);
    if (!hole) continue;
    holes.push_back(*hole);
    // Of 16 points at random in such a disc it would be a quarter of its radius.
    ratios.push_back(*hole / (0.25 * told[i].radius_of_16));
  }
  if (holes.empty() || quantile(std::move(ratios), 0.5) < kOpen) return 0.0;
  return std::sqrt(12.0) * quantile(std::move(holes), kShareOfPlaces);
}

}  // namespace rangezip
