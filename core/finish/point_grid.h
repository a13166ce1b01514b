#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/geometry.h"

namespace rangezip {

/// Points sorted into the cubes of a uniform grid, for visiting all around a place.
/// Stored as floats relative to a corner of the region: 12 bytes a point, one pass to sort.
class PointGrid {
 public:
  /// @param region points outside of it are left out
  /// @param cell side of the cubes, model units, positive; about half the usual radius is fast
  PointGrid(std::span<const Vec3> points, const Box& region, double cell);

  [[nodiscard]] bool empty() const noexcept { return positions_.empty(); }

  [[nodiscard]] std::size_t size() const noexcept { return positions_.size(); }

  /// The points, or `most` of them at most, spread evenly over the grid.
  [[nodiscard]] std::vector<Vec3> points(std::size_t most) const;

  /// Means of the points, each of which counts as so many, one for each part of a cube: every side
  /// is cut into `parts`. What is linear in the points, like the height of a surface that is wide
  /// against the parts, hardly changes. @pre 1 <= parts <= 4
  [[nodiscard]] PointGrid thinned(int parts) const;

  /// Calls visit(offset) with (point - place) for every point within `radius` of the place and some
  /// farther ones; always in the same order.
  template <class Visit>
  void for_each_near(const Vec3& place, double radius, Visit visit) const {
    for_each_index_near(place, radius, [&](std::size_t i, const Vec3& local) {
      visit(Vec3(positions_[i]) - local);
    });
  }

  /// The same with how many points it counts as: visit(offset, count).
  template <class Visit>
  void for_each_counted_near(const Vec3& place, double radius, Visit visit) const {
    for_each_index_near(place, radius, [&](std::size_t i, const Vec3& local) {
      visit(Vec3(positions_[i]) - local, counts_.empty() ? 1.0 : static_cast<double>(counts_[i]));
    });
  }

 private:
  PointGrid() = default;

  /// Calls visit(index, place in the grid).
  template <class Visit>
  void for_each_index_near(const Vec3& place, double radius, Visit visit) const {
    if (empty()) return;
    const Vec3 local = place - origin_;
    std::array<std::size_t, 3> lower{}, upper{};
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      const double low = (local[axis] - radius) * cells_per_unit_;
      const double high = (local[axis] + radius) * cells_per_unit_;
      if (!(high >= 0.0) || !(low < static_cast<double>(dims_[a]))) return;
      lower[a] = low > 0.0 ? static_cast<std::size_t>(low) : 0;
      upper[a] = std::min(static_cast<std::size_t>(high), dims_[a] - 1);
    }
    for (std::size_t z = lower[2]; z <= upper[2]; ++z) {
      for (std::size_t y = lower[1]; y <= upper[1]; ++y) {
        const std::size_t row = (z * dims_[1] + y) * dims_[0];
        const std::size_t end = starts_[row + upper[0] + 1];
        for (std::size_t i = starts_[row + lower[0]]; i < end; ++i) {
          visit(i, local);
        }
      }
    }
  }

  Vec3 origin_{0.0};
  double cells_per_unit_ = 1.0;
  std::array<std::size_t, 3> dims_{1, 1, 1};
  std::vector<std::uint32_t> starts_;  // of each cell in positions_, x fastest
  std::vector<Vec3f> positions_;
  std::vector<std::uint32_t> counts_;  // of points that a position stands for; empty: one each
};

}  // namespace rangezip
