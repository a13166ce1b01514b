#include "core/finish/share_field.h"

#include <cstddef>
#include <utility>

namespace rangezip {

namespace {

constexpr int kCorners = 8;

/// The steps along an axis from a cube to one of its corners.
int step_to(int corner, std::size_t axis) {
  return corner >> axis & 1;
}

}  // namespace

ShareField::ShareField(double side, std::vector<Cube> cubes, std::vector<double> shares)
    : side_(side), cubes_(std::move(cubes)), shares_(std::move(shares)) {
  Corners none{};
  none.fill(kNone);
  for (std::size_t i = 0; i < cubes_.size(); ++i) {
    for (int corner = 0; corner < kCorners; ++corner) {
      Cube first = cubes_[i];
      for (std::size_t axis = 0; axis < first.size(); ++axis)
        first[axis] -= step_to(corner, axis);
      corners_.try_emplace(first, none).first->second[static_cast<std::size_t>(corner)] =
          shares_[i];
    }
  }
}

double ShareField::at(const Vec3& place) const {
  if (cubes_.empty()) return 1.0;
  const Vec3 corner = place - Vec3(0.5 * side_);
  const Cube first = cube_of(corner, side_);
  const auto found = corners_.find(first);
  if (found == corners_.end()) return 1.0;
  double sum = 0.0, weight = 0.0;
  for (int i = 0; i < kCorners; ++i) {
    const double share = found->second[static_cast<std::size_t>(i)];
    if (share == kNone) continue;
    double w = 1.0;
    for (std::size_t a = 0; a < first.size(); ++a) {
      const double along = corner[static_cast<int>(a)] / side_ - static_cast<double>(first[a]);
      w *= step_to(i, a) == 0 ? 1.0 - along : along;
    }
    sum += w * share;
    weight += w;
  }
  return weight > 0.0 ? sum / weight : 1.0;
}

}  // namespace rangezip
