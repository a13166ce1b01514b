#pragma once

#include <cstdint>
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
  /// @param shares one per cube, for its centre
  ShareField(double side, std::vector<Cube> cubes, std::vector<double> shares);

  [[nodiscard]] bool is_one() const noexcept { return cubes_.empty(); }

  [[nodiscard]] double side() const noexcept { return side_; }
  [[nodiscard]] const std::vector<Cube>& cubes() const noexcept { return cubes_; }
  [[nodiscard]] const std::vector<double>& shares() const noexcept { return shares_; }

  /// Linear between the centres of cubes; where there are none nearby, 1.
  [[nodiscard]] double at(const Vec3& place) const;

 private:
  double side_ = 1.0;
  std::vector<Cube> cubes_;
  std::unordered_map<Cube, std::uint32_t, CubeHash> numbers_;  ///< of the cubes
  std::vector<double> shares_;
};

}  // namespace rangezip
