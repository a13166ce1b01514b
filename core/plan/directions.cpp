#include "core/plan/directions.h"

#include <cmath>
#include <string>

#include "core/base/error.h"

namespace rangezip {

std::vector<Vec3> sphere_directions(int count) {
  if (count < 1) {
    throw InvalidArgument("sphere_directions: count must be at least 1, got " +
                          std::to_string(count));
  }
  // cos and sin of the golden angle, pi (3 - sqrt(5)).
  constexpr double kGoldenCos = -0.73736887807831990;
  constexpr double kGoldenSin = 0.67549029426152364;

  std::vector<Vec3> directions;
  directions.reserve(static_cast<std::size_t>(count));
  Vec2 heading{1.0, 0.0};
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / count;
    const double radius = std::sqrt(1.0 - z * z);
    directions.emplace_back(radius * heading.x, radius * heading.y, z);
    heading = glm::normalize(Vec2{kGoldenCos * heading.x - kGoldenSin * heading.y,
                                  kGoldenSin * heading.x + kGoldenCos * heading.y});
  }
  return directions;
}

}  // namespace rangezip
