#include "core/mesh/places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>

#include "core/base/error.h"

namespace rangezip {
namespace {

using Cube = std::array<std::int64_t, 3>;

Cube cube_of(const Vec3& point, double side) {
  Cube cube{};
  for (int axis = 0; axis < 3; ++axis) {
    cube[static_cast<std::size_t>(axis)] =
        static_cast<std::int64_t>(std::floor(point[axis] / side));
  }
  return cube;
}

/// Number of the set of each cube after those that touch are joined. @pre `cubes` is sorted
std::vector<std::size_t> join_touching(const std::vector<Cube>& cubes) {
  std::vector<std::size_t> parent(cubes.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto find = [&](std::size_t i) {
    while (parent[i] != i)
      i = parent[i] = parent[parent[i]];
    return i;
  };
  for (std::size_t i = 0; i < cubes.size(); ++i) {
    for (int offset = 0; offset < 27; ++offset) {
      const Cube other{cubes[i][0] + offset % 3 - 1, cubes[i][1] + offset / 3 % 3 - 1,
                       cubes[i][2] + offset / 9 - 1};
      const auto found = std::lower_bound(cubes.begin(), cubes.end(), other);
      if (found == cubes.end() || *found != other) continue;
      const auto [low, high] =
          std::minmax({find(i), find(static_cast<std::size_t>(found - cubes.begin()))});
      parent[high] = low;
    }
  }
  for (std::size_t i = 0; i < parent.size(); ++i)
    parent[i] = find(i);
  return parent;
}

}  // namespace

std::vector<Place> places_of(std::span<const Vec3> points, std::span<const double> areas,
                             double reach) {
  if (!(reach > 0.0) || !std::isfinite(reach)) {
    throw InvalidArgument("places_of: reach must be positive and finite, got " +
                          std::to_string(reach));
  }
  if (points.size() != areas.size()) {
    throw InvalidArgument("places_of: there must be as many areas as points, got " +
                          std::to_string(areas.size()) + " for " + std::to_string(points.size()));
  }
  std::vector<Cube> cubes;
  for (const Vec3& point : points)
    cubes.push_back(cube_of(point, reach));
  std::sort(cubes.begin(), cubes.end());
  cubes.erase(std::unique(cubes.begin(), cubes.end()), cubes.end());
  const std::vector<std::size_t> set_of_cube = join_touching(cubes);

  std::vector<std::size_t> set_of_point;
  std::vector<Place> places(cubes.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto cube = std::lower_bound(cubes.begin(), cubes.end(), cube_of(points[i], reach));
    set_of_point.push_back(set_of_cube[static_cast<std::size_t>(cube - cubes.begin())]);
    Place& place = places[set_of_point.back()];
    place.center += points[i];
    place.area += areas[i];
    ++place.points;
  }
  for (Place& place : places) {
    if (place.points > 0) place.center /= static_cast<double>(place.points);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    Place& place = places[set_of_point[i]];
    place.radius = std::max(place.radius, glm::length(points[i] - place.center));
  }
  std::erase_if(places, [](const Place& place) { return place.points == 0; });
  std::stable_sort(places.begin(), places.end(),
                   [](const Place& a, const Place& b) { return a.points > b.points; });
  return places;
}

}  // namespace rangezip
