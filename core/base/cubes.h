#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/geometry.h"
#include "core/base/spread.h"

namespace rangezip {

/// A cube of an endless grid, by its place along each axis.
using Cube = std::array<std::int64_t, 3>;

/// The cube that a point lies in; one of the outermost for points over 10^15 cubes away, as far
/// outliers may be.
/// @param side of the cubes, model units; positive
[[nodiscard]] inline Cube cube_of(const Vec3& point, double side) noexcept {
  const auto along = [side](double coordinate) {
    constexpr double kOutermost = 1e15;
    return static_cast<std::int64_t>(
        std::clamp(std::floor(coordinate / side), -kOutermost, kOutermost));
  };
  return {along(point.x), along(point.y), along(point.z)};
}

/// For containers that hash.
struct CubeHash {
  [[nodiscard]] std::size_t operator()(const Cube& cube) const noexcept {
    std::uint64_t bits = 0;
    for (const std::int64_t coordinate : cube)
      bits = scrambled_bits(bits ^ static_cast<std::uint64_t>(coordinate));
    return static_cast<std::size_t>(bits);
  }
};

/// Sorts cubes, each once.
inline void sort_cubes(std::vector<Cube>& cubes) {
  std::sort(cubes.begin(), cubes.end());
  cubes.erase(std::unique(cubes.begin(), cubes.end()), cubes.end());
}

/// The number of a cube among sorted ones; as many as there are if it is none of them.
[[nodiscard]] inline std::size_t find_cube(const std::vector<Cube>& cubes,
                                           const Cube& cube) noexcept {
  const auto found = std::lower_bound(cubes.begin(), cubes.end(), cube);
  if (found == cubes.end() || *found != cube) return cubes.size();
  return static_cast<std::size_t>(found - cubes.begin());
}

/// Calls visit(cube) for a cube and the 26 that touch it.
template <class Visit>
void for_each_cube_around(const Cube& cube, const Visit& visit) {
  for (int offset = 0; offset < 27; ++offset) {
    visit(Cube{cube[0] + offset % 3 - 1, cube[1] + offset / 3 % 3 - 1, cube[2] + offset / 9 - 1});
  }
}

/// Calls visit(number) for a cube and those that touch it, as far as they are among sorted ones.
template <class Visit>
void for_each_cube_around(const std::vector<Cube>& cubes, const Cube& cube, const Visit& visit) {
  for_each_cube_around(cube, [&](const Cube& other) {
    const std::size_t number = find_cube(cubes, other);
    if (number < cubes.size()) visit(number);
  });
}

}  // namespace rangezip
