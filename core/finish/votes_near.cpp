#include "core/finish/votes_near.h"

#include <cstddef>

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

VoteGrid::VoteGrid(const SeenPoints& seen, std::span<const Vec3> places, double radius)
    : seen_(seen), radius_(radius) {
  for (const Vec3& place : places)
    for_each_cube_around(cube_of(place, radius), [&](const Cube& cube) { points_in_[cube]; });
  const auto is_near = flags_of(seen.votes.size(), [&](std::size_t p) {
    return points_in_.contains(cube_of(seen.points[p], radius));
  });
  for (std::uint32_t p = 0; p < is_near.size(); ++p) {
    if (is_near[p] != 0) points_in_.at(cube_of(seen.points[p], radius)).push_back(p);
  }
}

bool VoteGrid::look_out_of_back(const std::vector<Vec3>& positions, const Triangle& face) const {
  return around(centroid_of(positions, face)).look_toward(-unit_normal(positions, face));
}

VotesNear VoteGrid::around(const Vec3& place) const {
  VotesNear near;
  for_each_cube_around(cube_of(place, radius_), [&](const Cube& cube) {
    const auto found = points_in_.find(cube);
    if (found == points_in_.end()) return;
    for (const std::uint32_t p : found->second) {
      if (glm::length(place - seen_.points[p]) > radius_) continue;
      const auto& [x, y, z] = seen_.votes[p];
      near.sum += Vec3(x, y, z);
      ++near.count;
    }
  });
  return near;
}

}  // namespace rangezip
