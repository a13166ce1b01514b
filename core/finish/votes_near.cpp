#include "core/finish/votes_near.h"

#include <cstdint>
#include <unordered_map>

#include "core/base/cubes.h"
#include "core/finish/places_near.h"

namespace rangezip {
namespace {

constexpr double kClearly = 0.25;
constexpr double kFullVote = 127.0;
constexpr double kLeastVote = 0.05 * kFullVote;

}  // namespace

bool VotesNear::look_toward(const Vec3& unit) const {
  const double length = glm::length(sum);
  return length > kLeastVote * static_cast<double>(count) &&
         glm::dot(sum, unit) > kClearly * length;
}

std::vector<VotesNear> votes_near(std::span<const Vec3> places, const SeenPoints& seen,
                                  double radius) {
  std::unordered_map<Cube, std::vector<std::size_t>, CubeHash> places_in;  // and around a cube
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Cube center = cube_of(places[i], radius);
    for (int k = 0; k < 27; ++k) {
      const Cube cube{center[0] + k % 3 - 1, center[1] + k / 3 % 3 - 1, center[2] + k / 9 - 1};
      places_in[cube].push_back(i);
    }
  }
  const auto is_near = flags_of(seen.votes.size(), [&](std::size_t p) {
    return places_in.contains(cube_of(seen.points[p], radius));
  });
  std::vector<VotesNear> sums(places.size());
  for (std::size_t p = 0; p < is_near.size(); ++p) {
    if (is_near[p] == 0) continue;
    const Vec3& point = seen.points[p];
    const auto& [x, y, z] = seen.votes[p];
    for (const std::size_t i : places_in.at(cube_of(point, radius))) {
      if (glm::length(places[i] - point) > radius) continue;
      sums[i].sum += Vec3(x, y, z);
      ++sums[i].count;
    }
  }
  return sums;
}

}  // namespace rangezip
