#include "core/reconstruct/dense_places.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/base/cubes.h"
#include "core/base/sphere_set.h"
#include "core/finish/local_sizes.h"

namespace rangezip {
namespace {

constexpr std::int64_t kAlong = 4;      ///< cubes along the side of what becomes a sphere
constexpr std::size_t kMinCubes = 8;    ///< fewer are hardly a patch
constexpr double kHalfDiagonal = 0.87;  ///< of a cube of side 1

std::int64_t divided(std::int64_t a, std::int64_t b) {
  return a >= 0 ? a / b : -((b - 1 - a) / b);
}

/// The spheres around blocks of cubes.
std::vector<Sphere> spheres_around(const std::vector<Cube>& cubes, double side) {
  std::vector<Cube> blocks;
  blocks.reserve(cubes.size());
  for (const Cube& c : cubes)
    blocks.push_back({divided(c[0], kAlong), divided(c[1], kAlong), divided(c[2], kAlong)});
  std::vector<Cube> sorted = blocks;
  sort_cubes(sorted);
  std::vector<Box> boxes(sorted.size());
  for (std::size_t i = 0; i < cubes.size(); ++i) {
    const Cube& c = cubes[i];
    const Vec3 center =
        side * Vec3(static_cast<double>(c[0]) + 0.5, static_cast<double>(c[1]) + 0.5,
                    static_cast<double>(c[2]) + 0.5);
    boxes[find_cube(sorted, blocks[i])].add(center);
  }
  std::vector<Sphere> spheres;
  spheres.reserve(boxes.size());
  for (const Box& box : boxes)
    spheres.push_back({0.5 * (box.lower + box.upper), 0.5 * box.diagonal() + kHalfDiagonal * side});
  return spheres;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

DensePlaces find_dense_places(std::span<const Vec3> points, const TriangleMesh& mesh,
                              double pixel_size, double noise) {
  Box region = bounds_of(mesh);
  region.lower -= Vec3(pixel_size);
  region.upper += Vec3(pixel_size);
  const PointGrid cloud(points, region, pixel_size);
  const ShareField sizes = local_sizes(mesh, cloud, pixel_size, noise);
  std::vector<Cube> dense;
  std::vector<double> shares;
  for (std::size_t i = 0; i < sizes.cubes().size(); ++i) {
    if (sizes.shares()[i] == 1.0) continue;
    dense.push_back(sizes.cubes()[i]);
    shares.push_back(sizes.shares()[i]);
  }
  if (dense.size() < kMinCubes) return {};
  DensePlaces found;
  found.places = spheres_around(dense, sizes.side());
  found.pixel_size = median(std::move(shares)) * pixel_size;
  const SphereSet inside(found.places);
  for (const Vec3& p : points) {
    if (inside.contains(p)) found.points.push_back(p);
  }
  return found;
}

}  // namespace rangezip
