#include "core/reconstruct/dense_places.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/base/cubes.h"
#include "core/base/sphere_set.h"
#include "core/finish/local_sizes.h"

namespace rangezip {
namespace {

constexpr double kAlong = 4.0;          ///< cubes along the side of what becomes a sphere
constexpr std::size_t kMinCubes = 8;    ///< fewer are hardly a patch
constexpr double kHalfDiagonal = 0.87;  ///< of a cube of side 1

/// The spheres around blocks of cubes.
std::vector<Sphere> spheres_around(const std::vector<Cube>& cubes, double side) {
  const auto center_of = [&](const Cube& c) { return side * (Vec3(c[0], c[1], c[2]) + Vec3(0.5)); };
  std::vector<Cube> blocks;
  blocks.reserve(cubes.size());
  for (const Cube& c : cubes)
    blocks.push_back(cube_of(center_of(c), kAlong * side));
  sort_cubes(blocks);
  std::vector<Box> boxes(blocks.size());
  for (const Cube& c : cubes)
    boxes[find_cube(blocks, cube_of(center_of(c), kAlong * side))].add(center_of(c));
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
  const Box region = widened(bounds_of(mesh), pixel_size);
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
