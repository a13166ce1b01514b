#include "core/mesh/places.h"

#include <algorithm>
#include <cstdint>
#include <string>

#include "core/base/check_number.h"
#include "core/base/cubes.h"
#include "core/base/disjoint_sets.h"
#include "core/base/error.h"

namespace rangezip {
namespace {

void check(std::span<const Vec3> points, std::span<const double> areas, double reach) {
  check_positive("places_of: reach", reach);
  if (points.size() != areas.size()) {
    throw InvalidArgument("places_of: there must be as many areas as points, got " +
                          std::to_string(areas.size()) + " for " + std::to_string(points.size()));
  }
}

/// For each cube the number of what it makes with those that touch it, in the order of the cubes.
/// @pre `cubes` is sorted
std::vector<std::uint32_t> join_touching(const std::vector<Cube>& cubes) {
  DisjointSets sets(cubes.size());
  for (std::uint32_t i = 0; i < cubes.size(); ++i) {
    for_each_cube_around(cubes, cubes[i], [&](std::size_t other) {
      sets.join(i, static_cast<std::uint32_t>(other));
    });
  }
  std::vector<std::uint32_t> number(cubes.size());
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < cubes.size(); ++i) {
    const std::uint32_t first = sets.find(i);
    number[i] = first == i ? count++ : number[first];
  }
  return number;
}

/// For each point the number of its place.
std::vector<std::uint32_t> numbers_of(std::span<const Vec3> points, double reach) {
  std::vector<Cube> cubes;
  for (const Vec3& point : points)
    cubes.push_back(cube_of(point, reach));
  sort_cubes(cubes);
  const std::vector<std::uint32_t> number_of_cube = join_touching(cubes);
  std::vector<std::uint32_t> numbers;
  for (const Vec3& point : points)
    numbers.push_back(number_of_cube[find_cube(cubes, cube_of(point, reach))]);
  return numbers;
}

}  // namespace

std::vector<Place> places_of(std::span<const Vec3> points, std::span<const double> areas,
                             double reach) {
  check(points, areas, reach);
  if (points.empty()) return {};
  const std::vector<std::uint32_t> numbers = numbers_of(points, reach);
  std::vector<Place> places(*std::max_element(numbers.begin(), numbers.end()) + std::size_t{1});
  for (std::size_t i = 0; i < points.size(); ++i) {
    Place& place = places[numbers[i]];
    place.center += points[i];
    place.area += areas[i];
    ++place.points;
  }
  for (Place& place : places)
    place.center /= static_cast<double>(place.points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    Place& place = places[numbers[i]];
    place.radius = std::max(place.radius, glm::length(points[i] - place.center));
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const Place& a, const Place& b) { return a.points > b.points; });
  return places;
}

}  // namespace rangezip
