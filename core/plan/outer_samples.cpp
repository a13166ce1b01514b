#include "core/plan/outer_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "core/base/disjoint_sets.h"
#include "core/base/parallel.h"
#include "core/plan/scene_triangles.h"

namespace rangezip {
namespace {

constexpr double kFewestCells = 16.0, kMostCells = 1024.0;  ///< along a side of the grid
/// Of the scene's diagonal: a triangle so near to a sample is the sample's own, or touches it.
constexpr double kOwn = 1e-6;
constexpr double kMostInner = 0.01;  ///< of samples
constexpr std::size_t kPerBlock = 1024;

using Place = std::array<double, 2>;  ///< across an axis

/// Whether a place is to the left of a side, or on it, decided the same for both triangles of it.
bool is_left(const Place& from, const Place& to, const Place& place) {
  const bool is_swapped = to < from;
  const Place &p = is_swapped ? to : from, &q = is_swapped ? from : to;
  const double turn = (q[0] - p[0]) * (place[1] - p[1]) - (q[1] - p[1]) * (place[0] - p[0]);
  return (turn >= 0.0) != is_swapped;
}

/// What a line along an axis tells of a sample.
struct Told {
  bool is_outer = false;
  std::size_t triangle = 0;  ///< that the sample lies on
};

/// The triangles of a scene by the lines along an axis that meet them.
class AxisLines {
 public:
  AxisLines(const std::vector<TriangleCorners>& triangles, const Box& bounds, int axis)
      : triangles_(triangles), up_(axis), u_((axis + 1) % 3), v_((axis + 2) % 3) {
    const double cells = std::sqrt(static_cast<double>(triangles.size()));
    side_ = static_cast<std::size_t>(std::clamp(cells, kFewestCells, kMostCells));
    origin_ = across(bounds.lower);
    const Place end = across(bounds.upper);
    for (std::size_t i = 0; i < 2; ++i) {
      const double extent = end[i] - origin_[i];
      per_cell_[i] = extent > kTiny ? static_cast<double>(side_) / extent : 1.0;
    }
    sort_into_cells();
  }

  /// Whether one side of the triangle that a sample lies on is outside of all bodies, and that
  /// triangle; nothing if its line does not tell.
  [[nodiscard]] std::optional<Told> look_along(const Vec3& sample, double own) const {
    Told told;
    int above = 0, from_below = 0, all = 0;
    const Place place = across(sample);
    const std::size_t cell = cell_of(place[0], 0) * side_ + cell_of(place[1], 1);
    for (std::size_t i = begin_[cell]; i < begin_[cell + 1]; ++i) {
      const TriangleCorners& t = triangles_[entries_[i]];
      const int sign = crossing(t, place);
      if (sign == 0) continue;
      const double height = height_at(t, place) - sample[up_];
      all += sign;
      if (height > own) above += sign;
      if (height > -own) from_below += sign;
      if (std::abs(height) <= own) told.triangle = entries_[i];
    }
    if (all != 0 || above == from_below) return std::nullopt;
    told.is_outer = above == 0 || from_below == 0;
    return told;
  }

 private:
  static constexpr double kTiny = 1e-200;  ///< model units: flat
  static constexpr double kBeside = 1e-6;  ///< of a cell: what rounding may move

  [[nodiscard]] Place across(const Vec3& p) const { return {p[u_], p[v_]}; }

  [[nodiscard]] std::size_t cell_of(double x, std::size_t i) const {
    const double cell = (x - origin_[i]) * per_cell_[i];
    return static_cast<std::size_t>(std::clamp(cell, 0.0, static_cast<double>(side_ - 1)));
  }

  /// The cells that a triangle meets, by columns: a long sliver across the grid meets few.
  template <class Visitor>
  void for_each_cell(const TriangleCorners& t, const Visitor& visit) const {
    const std::array<Place, 3> corners{across(t.a), across(t.b), across(t.c)};
    const auto [first, last] = std::minmax({corners[0][0], corners[1][0], corners[2][0]});
    for (std::size_t x = cell_of(first, 0); x <= cell_of(last, 0); ++x) {
      const auto [lower, upper] = range_in_column(corners, x);
      for (std::size_t y = cell_of(lower, 1); y <= cell_of(upper, 1); ++y)
        visit(x * side_ + y);
    }
  }

  /// How far down and up a triangle reaches in a column of cells, and a little farther.
  [[nodiscard]] std::pair<double, double> range_in_column(const std::array<Place, 3>& corners,
                                                          std::size_t column) const {
    const double left = origin_[0] + (static_cast<double>(column) - kBeside) / per_cell_[0];
    const double right = origin_[0] + (static_cast<double>(column + 1) + kBeside) / per_cell_[0];
    double lower = std::numeric_limits<double>::infinity(), upper = -lower;
    for (std::size_t i = 0; i < 3; ++i) {
      const Place &p = corners[i], &q = corners[(i + 1) % 3];
      if (std::max(p[0], q[0]) < left || std::min(p[0], q[0]) > right) continue;
      const double run = q[0] - p[0];
      const auto share_at = [&](double x) { return std::clamp((x - p[0]) / run, 0.0, 1.0); };
      const double from = run == 0.0 ? 0.0 : share_at(left);
      const double to = run == 0.0 ? 1.0 : share_at(right);
      for (const double share : {from, to}) {
        const double y = p[1] + share * (q[1] - p[1]);
        lower = std::min(lower, y);
        upper = std::max(upper, y);
      }
    }
    return {lower - kBeside / per_cell_[1], upper + kBeside / per_cell_[1]};
  }

  void sort_into_cells() {
    begin_.assign(side_ * side_ + 1, 0);
    for (const TriangleCorners& t : triangles_)
      for_each_cell(t, [&](std::size_t cell) { ++begin_[cell + 1]; });
    for (std::size_t i = 1; i < begin_.size(); ++i)
      begin_[i] += begin_[i - 1];
    entries_.resize(begin_.back());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t i = 0; i < triangles_.size(); ++i)
      for_each_cell(triangles_[i], [&](std::size_t cell) { entries_[next[cell]++] = i; });
  }

  /// 1 where a line leaves a body upwards, -1 where it enters one, 0 beside the triangle.
  [[nodiscard]] int crossing(const TriangleCorners& t, const Place& place) const {
    const Place a = across(t.a), b = across(t.b), c = across(t.c);
    const bool left = is_left(a, b, place);
    if (is_left(b, c, place) != left || is_left(c, a, place) != left) return 0;
    return left ? 1 : -1;
  }

  [[nodiscard]] double height_at(const TriangleCorners& t, const Place& place) const {
    const Vec3 normal = area_vector(t.a, t.b, t.c);
    const double slope = normal[u_] * (place[0] - t.a[u_]) + normal[v_] * (place[1] - t.a[v_]);
    return t.a[up_] - slope / normal[up_];
  }

  const std::vector<TriangleCorners>& triangles_;
  int up_, u_, v_;
  std::size_t side_ = 0;
  Place origin_{}, per_cell_{};
  std::vector<std::size_t> begin_;    ///< of each cell, in entries_
  std::vector<std::size_t> entries_;  ///< triangles, by cell
};

/// Flags of the triangles of closed voids: pieces, joined at corners, that look inwards where all
/// together look outwards, or the other way round.
std::vector<std::uint8_t> triangles_of_voids(const std::vector<TriangleCorners>& triangles,
                                             const Vec3& origin) {
  const auto corner = [&](std::size_t i) -> const Vec3& {
    const TriangleCorners& t = triangles[i / 3];
    return i % 3 == 0 ? t.a : i % 3 == 1 ? t.b : t.c;
  };
  const auto key = [&](std::size_t i) {
    const Vec3& p = corner(i);
    return std::tuple{p.x, p.y, p.z};
  };
  std::vector<std::size_t> order(3 * triangles.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t i, std::size_t k) { return key(i) < key(k); });
  DisjointSets pieces(triangles.size());
  for (std::size_t n = 1; n < order.size(); ++n) {
    if (key(order[n - 1]) == key(order[n]))
      pieces.join(static_cast<std::uint32_t>(order[n - 1] / 3),
                  static_cast<std::uint32_t>(order[n] / 3));
  }
  const auto piece_of = [&](std::size_t i) { return pieces.find(static_cast<std::uint32_t>(i)); };
  std::vector<double> volumes(triangles.size(), 0.0);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto& [a, b, c] = triangles[i];
    volumes[piece_of(i)] += glm::dot(a - origin, glm::cross(b - origin, c - origin));
  }
  const double all = std::accumulate(volumes.begin(), volumes.end(), 0.0);
  std::vector<std::uint8_t> is_of_void(triangles.size(), 0);
  for (std::size_t i = 0; i < triangles.size(); ++i)
    is_of_void[i] = volumes[piece_of(i)] * all < 0.0 ? 1 : 0;
  return is_of_void;
}

}  // namespace

bool are_outer(const std::vector<std::uint8_t>& is_outer) {
  const auto inner = std::count(is_outer.begin(), is_outer.end(), 0);
  return static_cast<double>(inner) <= kMostInner * static_cast<double>(is_outer.size());
}

std::vector<std::uint8_t> outer_samples(const Scene& scene, std::span<const Vec3> samples,
                                        const Progress& progress) {
  std::vector<std::uint8_t> is_outer(samples.size(), 0);
  if (samples.empty()) return is_outer;
  std::vector<TriangleCorners> triangles;
  triangles.reserve(scene.triangle_count());
  for_each_triangle(scene, [&](const TriangleCorners& t) { triangles.push_back(t); });
  const std::vector<std::uint8_t> is_of_void =
      triangles_of_voids(triangles, scene.bounds().center());
  std::vector<std::uint8_t> is_inner(samples.size(), 0);
  const double own = kOwn * scene.bounds().diagonal();
  for (int axis = 0; axis < 3; ++axis) {
    progress.check_stop();
    const AxisLines lines(triangles, scene.bounds(), axis);
    parallel_for(samples.size(), kPerBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const std::optional<Told> told = lines.look_along(samples[i], own);
        if (!told) continue;
        const bool counts = told->is_outer && is_of_void[told->triangle] == 0;
        (counts ? is_outer : is_inner)[i] = 1;
      }
    });
  }
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (is_inner[i] != 0) is_outer[i] = 0;
  }
  return is_outer;
}

}  // namespace rangezip
