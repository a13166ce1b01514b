#include "core/finish/share_field.h"

#include <cstddef>
#include <utility>

namespace rangezip {

ShareField::ShareField(double side, std::vector<Cube> cubes, std::vector<double> shares)
    : side_(side), cubes_(std::move(cubes)), shares_(std::move(shares)) {
  numbers_.reserve(cubes_.size());
  for (std::uint32_t number = 0; number < cubes_.size(); ++number)
    numbers_.emplace(cubes_[number], number);
}

double ShareField::at(const Vec3& place) const {
  if (cubes_.empty()) return 1.0;
  const Vec3 corner = place - Vec3(0.5 * side_);
  const Cube first = cube_of(corner, side_);
  double sum = 0.0, weight = 0.0;
  for (int i = 0; i < 8; ++i) {
    const Cube cube{first[0] + (i & 1), first[1] + (i >> 1 & 1), first[2] + (i >> 2)};
    const auto found = numbers_.find(cube);
    if (found == numbers_.end()) continue;
    double w = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      const double along = corner[axis] / side_ - static_cast<double>(first[a]);
      w *= cube[a] == first[a] ? 1.0 - along : along;
    }
    sum += w * shares_[found->second];
    weight += w;
  }
  return weight > 0.0 ? sum / weight : 1.0;
}

}  // namespace rangezip
