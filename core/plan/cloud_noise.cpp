#include "core/plan/cloud_noise.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "core/plan/own_sheet.h"
#include "core/plan/slab_index.h"

namespace rangezip {
namespace {

constexpr double kRadiusPerNoise = 4.0;
constexpr int kRounds = 8;
/// More points hardly tell more.
constexpr std::size_t kMostPoints = 4096;

/// The places whose balls are too narrow for their noise, in the order of x.
std::vector<NoisePlace*> narrow_places(std::vector<NoisePlace>& places) {
  std::vector<NoisePlace*> narrow;
  for (NoisePlace& place : places) {
    if (kRadiusPerNoise * place.noise > place.radius) narrow.push_back(&place);
  }
  std::sort(narrow.begin(), narrow.end(),
            [](const NoisePlace* a, const NoisePlace* b) { return a->center.x < b->center.x; });
  return narrow;
}

/// Brings the nearest ones to the front, where they tell which side of a wall is meant, and thins
/// the others.
void sort_and_thin(std::vector<Vec3>& offsets) {
  std::stable_sort(offsets.begin(), offsets.end(),
                   [](const Vec3& a, const Vec3& b) { return glm::dot(a, a) < glm::dot(b, b); });
  constexpr std::size_t kFront = 16;
  const std::size_t step = offsets.size() / kMostPoints + 1;
  std::size_t kept = std::min(kFront, offsets.size());
  for (std::size_t i = kept; i < offsets.size(); i += step)
    offsets[kept++] = offsets[i];
  offsets.resize(kept);
}

}  // namespace

void widen_over_noise(std::span<const Vec3> points, std::vector<NoisePlace>& places) {
  const std::vector<NoisePlace> before = places;
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<NoisePlace*> narrow = narrow_places(places);
    if (narrow.empty()) return;
    std::vector<SlabIndex::Ball> balls;
    for (NoisePlace* place : narrow) {
      place->radius *= std::numbers::sqrt2;
      balls.push_back({place->center, place->radius});
    }
    std::vector<std::vector<Vec3>> inside = offsets_in_balls(balls, points);
    for (std::size_t i = 0; i < narrow.size(); ++i) {
      inside[i].insert(inside[i].begin(), Vec3(0.0));  // the centre is a point, too
      sort_and_thin(inside[i]);
      narrow[i]->noise = distance_from_plane(inside[i], narrow[i]->wall);
    }
  }
  for (const NoisePlace* place : narrow_places(places)) {
    const std::size_t i = static_cast<std::size_t>(place - places.data());
    places[i] = before[i];
  }
}

}  // namespace rangezip
