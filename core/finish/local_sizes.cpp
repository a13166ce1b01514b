#include "core/finish/local_sizes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "core/base/cubes.h"
#include "core/base/parallel.h"
#include "core/finish/corner_table.h"
#include "core/finish/vertex_geometry.h"

namespace rangezip {
namespace {

// Lengths are in h.
constexpr double kRadius = 1.0;           // of the disc in which points are counted
constexpr double kHeight = 0.5;           // what is farther from the disc is another sheet
constexpr double kCube = 2.0;             // the side
constexpr double kPixelPerSpacing = 2.2;  // as for the pixel of all scans (core/plan/spacing.h)
constexpr double kPixelPerNoise = 4.0;    // the same
constexpr double kClearly = 0.6;          // a larger share does not count as denser
constexpr double kSmallest = 0.25;
constexpr double kMinPoints = 100.0;  // with fewer a density is by chance
constexpr std::uint32_t kStride = 4;  // of the vertices that are asked
constexpr std::size_t kPerBlock = 256;

/// Sums over the vertices in a cube.
struct Counts {
  double vertices = 0.0;
  double points = 0.0;  ///< in their discs
};

struct CountsOfCubes {
  std::vector<Cube> cubes;  ///< sorted
  std::vector<Counts> counts;
};

double points_in_disc(const PointGrid& cloud, const Vec3& place, const Vec3& normal, double h) {
  const double radius2 = kRadius * kRadius * h * h;
  double count = 0.0;
  cloud.for_each_near(place, kRadius * h, [&](const Vec3& offset) {
    const double height = glm::dot(offset, normal);
    const bool is_inside = glm::dot(offset, offset) - height * height <= radius2;
    if (is_inside && std::abs(height) <= kHeight * h) count += 1.0;
  });
  return count;
}

CountsOfCubes count_points(const TriangleMesh& mesh, const PointGrid& cloud, double h) {
  const CornerTable table(mesh.triangles, mesh.positions.size());
  const std::size_t asked = (mesh.positions.size() + kStride - 1) / kStride;
  std::vector<double> found(asked, 0.0);
  parallel_for(asked, kPerBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto v = static_cast<std::uint32_t>(kStride * i);
      if (table.corner_of(v) == CornerTable::kNone) continue;
      const Vec3 normal = vertex_normal(table, mesh.positions, v);
      found[i] = points_in_disc(cloud, mesh.positions[v], normal, h);
    }
  });
  CountsOfCubes all;
  const auto cube_at = [&](std::size_t i) {
    return cube_of(mesh.positions[kStride * i], kCube * h);
  };
  for (std::size_t i = 0; i < asked; ++i) {
    if (found[i] > 0.0) all.cubes.push_back(cube_at(i));
  }
  sort_cubes(all.cubes);
  all.counts.resize(all.cubes.size());
  for (std::size_t i = 0; i < asked; ++i) {
    if (!(found[i] > 0.0)) continue;
    Counts& counts = all.counts[find_cube(all.cubes, cube_at(i))];
    counts.vertices += 1.0;
    counts.points += found[i];
  }
  return all;
}

/// For each cube what its surroundings demand.
std::vector<double> shares_of(const CountsOfCubes& all, double h, double noise) {
  constexpr double kDisc = std::numbers::pi * kRadius * kRadius;
  std::vector<double> shares(all.cubes.size(), 1.0);
  for (std::size_t c = 0; c < shares.size(); ++c) {
    Counts around;
    for_each_cube_around(all.cubes, all.cubes[c], [&](std::size_t other) {
      around.vertices += all.counts[other].vertices;
      around.points += all.counts[other].points;
    });
    if (around.points < kMinPoints) continue;
    const double spacing = std::sqrt(kDisc * around.vertices / around.points);
    const double share = std::max(kPixelPerSpacing * spacing, kPixelPerNoise * noise / h);
    if (share <= kClearly) shares[c] = std::max(kSmallest, share);
  }
  return shares;
}

}  // namespace

ShareField local_sizes(const TriangleMesh& mesh, const PointGrid& cloud, double pixel_size,
                       double noise) {
  if (cloud.empty() || mesh.empty()) return {};
  CountsOfCubes all = count_points(mesh, cloud, pixel_size);
  std::vector<double> shares = shares_of(all, pixel_size, noise);
  const bool is_even = std::all_of(shares.begin(), shares.end(), [](double s) { return s == 1.0; });
  if (is_even) return {};
  return {kCube * pixel_size, std::move(all.cubes), std::move(shares)};
}

}  // namespace rangezip
