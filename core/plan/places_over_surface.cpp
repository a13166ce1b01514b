#include "core/plan/places_over_surface.h"

#include <cstdint>
#include <unordered_map>

#include "core/base/cubes.h"
#include "core/base/spread.h"

namespace rangezip {
namespace {

constexpr double kCubesAlong = 16.0;
constexpr std::size_t kLookedAt = 100'000;
constexpr std::size_t kLeast = 3;

}  // namespace

std::vector<Vec3> places_over_surface(std::span<const Vec3> points, const Box& box,
                                      std::size_t wanted) {
  const double side = box.diagonal() / kCubesAlong;
  if (!(side > 0.0)) return {};
  const std::vector<std::size_t> looked_at = spread_indices(points.size(), kLookedAt);
  std::unordered_map<Cube, std::size_t, CubeHash> counts;
  for (const std::size_t i : looked_at)
    ++counts[cube_of(points[i] - box.lower, side)];
  std::vector<Vec3> firsts;
  for (const std::size_t i : looked_at) {
    const auto found = counts.find(cube_of(points[i] - box.lower, side));
    if (found->second < kLeast) continue;
    firsts.push_back(points[i]);
    found->second = 0;  // the others of this cube are passed over
  }
  std::vector<Vec3> places;
  for (const std::size_t i : spread_indices(firsts.size(), wanted))
    places.push_back(firsts[i]);
  return places;
}

}  // namespace rangezip
