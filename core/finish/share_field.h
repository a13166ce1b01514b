#pragma once

#include <array>
#include <unordered_map>
#include <vector>

#include "core/base/cubes.h"
#include "core/base/geometry.h"

namespace rangezip {

/// A length from place to place, as a share of one for all: continuous in space.
class ShareField {
 public:
  /// 1 everywhere.
  ShareField() = default;
  /// @param side of the cubes, model units
  /// @param cubes sorted, without repetitions
  /// @param shares one per cube, for its centre; none negative
  ShareField(double side, std::vector<Cube> cubes, std::vector<double> shares);

  [[nodiscard]] bool is_one() const noexcept { return cubes_.empty(); }

  [[nodiscard]] double side() const noexcept { return side_; }
  [[nodiscard]] const std::vector<Cube>& cubes() const noexcept { return cubes_; }
  [[nodiscard]] const std::vector<double>& shares() const noexcept { return shares_; }

  /// Linear between the centres of cubes; where there are none nearby, 1.
  [[nodiscard]] double at(const Vec3& place) const;

 private:
  static constexpr double kNone = -1.0;
  /// Of a cube and of those up to one farther along each axis, x fastest: all that a place between
  /// their centres asks for, found at once. kNone where there is no cube.
  using Corners = std::array<double, 8>;

  double side_ = 1.0;
  std::vector<Cube> cubes_;
  std::vector<double> shares_;
  std::unordered_map<Cube, Corners, CubeHash> corners_;
};

}  // namespace rangezip
