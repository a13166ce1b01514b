#include "core/finish/left_out_points.h"

#include <cstddef>
#include <cstdint>

#include "core/base/parallel.h"
#include "core/finish/places_near.h"
#include "core/finish/point_grid.h"
#include "core/mesh/coverage.h"

namespace rangezip {
namespace {

constexpr double kSurroundings = 2.0;  // in distances
constexpr std::size_t kPointsPerBlock = 512;
/// Of more points than these in a cube with sides of an eighth of the surroundings the first one
/// tells for all: scanners give what they did not see a hundred thousand times as one place.
constexpr std::uint32_t kPile = 64;
constexpr double kPileSide = 0.125;

/// For each of the points the one that is asked in its stead: mostly itself.
std::vector<std::uint32_t> asked_for(std::span<const Vec3> points, double side) {
  std::vector<std::uint32_t> asked = firsts_of_cubes(points, side);
  std::vector<std::uint32_t> counts(points.size(), 0);
  for (const std::uint32_t first : asked)
    ++counts[first];
  for (std::uint32_t i = 0; i < asked.size(); ++i) {
    if (counts[asked[i]] <= kPile) asked[i] = i;
  }
  return asked;
}

}  // namespace

std::vector<Vec3> left_out_points(std::span<const Vec3> points, const TriangleMesh& mesh,
                                  double distance) {
  return left_out_points(points, points_off(points, mesh, distance), mesh, distance);
}

std::vector<Vec3> left_out_points(std::span<const Vec3> points, const std::vector<Vec3>& farther,
                                  const TriangleMesh& mesh, double distance) {
  if (farther.empty() || mesh.empty()) return farther;
  const double radius = kSurroundings * distance;
  const Box region = widened(bounds_of(mesh), radius);  // what lies outside is left out as a whole
  const PointGrid all(points, region, 0.5 * radius), missed(farther, region, 0.5 * radius);
  const std::vector<std::uint32_t> asked = asked_for(farther, kPileSide * radius);
  std::vector<std::uint8_t> is_left_out(farther.size(), 0);
  parallel_for(farther.size(), kPointsPerBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (asked[i] != i) continue;
      const std::size_t around = all.count_within(farther[i], radius);
      is_left_out[i] = 2 * missed.count_within(farther[i], radius) >= around ? 1 : 0;
    }
  });
  std::vector<Vec3> left_out;
  for (std::size_t i = 0; i < farther.size(); ++i) {
    if (is_left_out[asked[i]] != 0) left_out.push_back(farther[i]);
  }
  return left_out;
}

}  // namespace rangezip
