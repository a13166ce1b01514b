#include "core/plan/visibility_vote.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <variant>

#include "core/base/check_number.h"
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/plan/directions.h"
#include "core/plan/front_sheet.h"
#include "core/plan/spacing.h"

namespace rangezip {

namespace {

using VoteSum = std::array<std::int16_t, 3>;

constexpr std::size_t kPointsPerBlock = 1U << 15U;
constexpr double kFullVote = 127.0;
/// A vote needs no finer image; more pixels only cost time.
constexpr double kMaxPixelsAcross = 2048.0;

/// The sum of the votes of a direction as an integer vector; `count` of them fit into 16 bits.
VoteSum vote_of(const Vec3& direction, int count) {
  const double unit = std::floor(32767.0 / count);
  VoteSum vote{};
  for (int axis = 0; axis < 3; ++axis) {
    vote[static_cast<std::size_t>(axis)] =
        static_cast<std::int16_t>(std::floor(unit * direction[axis] + 0.5));
  }
  return vote;
}

/// Scales sums so that a point of an open plane, which half of the directions see, gets a vote of
/// full length (the mean of a half sphere is half a unit long); none gets more.
VisibilityVotes scaled_votes(std::span<const VoteSum> sums, int count) {
  const double full_length = std::floor(32767.0 / count) * count * 0.25;
  VisibilityVotes votes(sums.size());
  parallel_for(sums.size(), kPointsPerBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 sum(sums[i][0], sums[i][1], sums[i][2]);
      const double scale = kFullVote / std::max(full_length, glm::length(sum));
      for (int axis = 0; axis < 3; ++axis) {
        votes[i][static_cast<std::size_t>(axis)] =
            static_cast<std::int8_t>(std::floor(scale * sum[axis] + 0.5));
      }
    }
  });
  return votes;
}

}  // namespace

VisibilityVotes visibility_votes(Rasterizer& rasterizer, const Scene& scene, double pixel_size,
                                 int direction_count, const Progress& progress) {
  check_positive("visibility_votes: pixel_size", pixel_size);
  if (direction_count < 1 || direction_count > kMaxVoteDirections) {
    throw InvalidArgument("visibility_votes: direction_count must lie in [1, " +
                          std::to_string(kMaxVoteDirections) + "], got " +
                          std::to_string(direction_count));
  }
  if (scene.point_count() == 0) return {};

  const Box bounds = robust_bounds(scene);
  const double side = std::max(pixel_size, bounds.diagonal() / kMaxPixelsAcross);
  const std::vector<DrawItem> items = scene.draw_items();
  std::vector<VoteSum> sums(scene.point_count());
  Framebuffer buffer;
  const std::vector<Vec3> directions = sphere_directions(direction_count);
  for (std::size_t d = 0; d < directions.size(); ++d) {
    progress.at("visibility vote", static_cast<double>(d) / direction_count);
    const FrontSheet front(rasterizer, items, bounds, directions[d], side, buffer);
    const VoteSum vote = vote_of(directions[d], direction_count);
    std::span<VoteSum> rest(sums);
    for (const DrawItem& item : items) {
      const auto* cloud = std::get_if<DrawPoints>(&item);
      if (cloud == nullptr) continue;
      front.for_each_seen(*cloud, [&](std::size_t i) {
        for (std::size_t axis = 0; axis < 3; ++axis)
          rest[i][axis] = static_cast<std::int16_t>(rest[i][axis] + vote[axis]);
      });
      rest = rest.subspan(cloud->positions.size());
    }
  }
  return scaled_votes(sums, direction_count);
}

std::vector<std::int8_t> votes_toward(const VisibilityVotes& votes, const Vec3& toward_viewer) {
  const double length = glm::length(toward_viewer);
  if (!(length > 0.0) || !std::isfinite(length)) {
    throw InvalidArgument("votes_toward: the direction must be finite and not zero");
  }
  const Vec3 direction = toward_viewer / length;
  std::vector<std::int8_t> along(votes.size());
  parallel_for(votes.size(), kPointsPerBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double dot = glm::dot(Vec3(votes[i][0], votes[i][1], votes[i][2]), direction);
      along[i] = static_cast<std::int8_t>(std::floor(std::clamp(dot, -kFullVote, kFullVote) + 0.5));
    }
  });
  return along;
}

}  // namespace rangezip
