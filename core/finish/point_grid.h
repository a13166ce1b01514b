#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
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

  /// One of the points, in the order of cells. @pre index < size()
  [[nodiscard]] Vec3 point(std::size_t index) const { return origin_ + Vec3(positions_[index]); }

  /// The points, or `most` of them at most, spread evenly over the grid.
  [[nodiscard]] std::vector<Vec3> points(std::size_t most) const;

  /// Notes which way the surface faces at each point.
  /// @param facing_at a unit vector for a point, or 0 where it is not known; called from any thread
  void note_facings(const std::function<Vec3(const Vec3&)>& facing_at);

  /// Means of the points, each of which counts as so many, one for each part of a cube: every side
  /// is cut into `parts`. What is linear in the points, like the height of a surface that is wide
  /// against the parts, hardly changes. Points that face away from others have means of their own.
  /// @pre 1 <= parts <= 4
  [[nodiscard]] PointGrid thinned(int parts) const;

  /// Calls visit(offset) with (point - place) for every point within `radius` of the place and some
  /// farther ones; always in the same order.
  template <class Visit>
  void for_each_near(const Vec3& place, double radius, Visit visit) const {
    for_each_run_near(place, radius, [&](std::size_t cell, std::size_t end, const Vec3& local) {
      for (std::size_t i = starts_[cell]; i < starts_[end]; ++i)
        visit(Vec3(positions_[i]) - local);
      return true;
    });
  }

  /// Whether a point lies within `radius` of the place: no more are looked at than tell that.
  [[nodiscard]] bool has_point_within(const Vec3& place, double radius) const {
    bool found = false;
    for_each_run_near(place, radius, [&](std::size_t cell, std::size_t end, const Vec3& local) {
      for (std::size_t i = starts_[cell]; i < starts_[end] && !found; ++i) {
        const Vec3 offset = Vec3(positions_[i]) - local;
        found = glm::dot(offset, offset) <= radius * radius;
      }
      return !found;
    });
    return found;
  }

  /// How many points lie within `radius` of the place.
  [[nodiscard]] std::size_t count_within(const Vec3& place, double radius) const {
    std::size_t count = 0;
    for_each_near(place, radius, [&](const Vec3& offset) {
      count += glm::dot(offset, offset) <= radius * radius ? 1 : 0;
    });
    return count;
  }

  /// The same as for_each_near with how many points it counts as, visit(offset, count), but for
  /// points that are known to face away from a unit normal (by more than 101 degrees).
  template <class Visit>
  void for_each_counted_near(const Vec3& place, double radius, const Vec3& normal,
                             Visit visit) const {
    const Vec3f side(normal);
    for_each_run_near(place, radius, [&](std::size_t cell, std::size_t end, const Vec3& local) {
      const bool may_face_away =
          !known_facings_.empty() && known_facings_[cell] < known_facings_[end];
      for (std::size_t i = starts_[cell]; i < starts_[end]; ++i) {
        if (may_face_away && faces_away(facings_[i], side)) continue;
        visit(Vec3(positions_[i]) - local, counts_.empty() ? 1.0 : static_cast<double>(counts_[i]));
      }
      return true;
    });
  }

 private:
  /// A unit vector in steps of 1 / kFacingSteps, or 0.
  using Facing = std::array<std::int8_t, 3>;
  static constexpr float kFacingSteps = 127.0F;

  [[nodiscard]] static Vec3f vector_of(const Facing& facing) {
    return {static_cast<float>(facing[0]), static_cast<float>(facing[1]),
            static_cast<float>(facing[2])};
  }

  [[nodiscard]] static bool faces_away(const Facing& facing, const Vec3f& normal) {
    constexpr float kAway = -0.2F * kFacingSteps;
    return glm::dot(vector_of(facing), normal) < kAway;
  }

  PointGrid() = default;

  /// For every cell how many facings are known in those before it.
  void count_known_facings();

  /// Calls visit(first cell, end, place in the grid) for rows of cells as long as it returns true.
  template <class Visit>
  void for_each_run_near(const Vec3& place, double radius, Visit visit) const {
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
        if (!visit(row + lower[0], row + upper[0] + 1, local)) return;
      }
    }
  }

  Vec3 origin_{0.0};
  double cells_per_unit_ = 1.0;
  std::array<std::size_t, 3> dims_{1, 1, 1};
  std::vector<std::uint32_t> starts_;  // of each cell in positions_, x fastest
  std::vector<Vec3f> positions_;
  std::vector<std::uint32_t> counts_;  // of points that a position stands for; empty: one each
  std::vector<Facing> facings_;        // of positions; empty: none is known
  std::vector<std::uint32_t> known_facings_;  // before each cell
};

}  // namespace rangezip
