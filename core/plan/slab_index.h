#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/geometry.h"

namespace rangezip {

/// Which of a few hundred balls a point may lie in: of slabs across the x axis each knows those
/// that reach into it. The slabs share the middle of the balls evenly; the first and last one reach
/// to infinity.
class SlabIndex {
 public:
  struct Ball {
    Vec3 center{0.0};
    double radius = 0.0;  ///< may be infinite
  };

  /// @pre `balls` are not empty, and sorted by the x of their centres
  explicit SlabIndex(std::span<const Ball> balls);

  /// The numbers of the balls that a point at this x may lie in.
  [[nodiscard]] std::span<const std::uint32_t> balls_near(double x) const {
    return balls_of_slab_[slab_of(x)];
  }

 private:
  static constexpr int kSlabs = 1024;

  [[nodiscard]] std::size_t slab_of(double x) const;

  double lower_ = 0.0;
  double slabs_per_unit_ = 0.0;
  std::array<std::vector<std::uint32_t>, kSlabs> balls_of_slab_;
};

/// Of each ball the offsets from its centre of the points that lie in it, but for the centre
/// itself, in the order of the points.
/// @pre as for SlabIndex; there may be none
[[nodiscard]] std::vector<std::vector<Vec3>> offsets_in_balls(
    std::span<const SlabIndex::Ball> balls, std::span<const Vec3> points);

}  // namespace rangezip
