#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/parallel.h"
#include "core/finish/face_part.h"
#include "core/finish/point_grid.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// Flags of 0 to count - 1, in parallel: 1 where is_in(i).
template <class IsIn>
[[nodiscard]] std::vector<std::uint8_t> flags_of(std::size_t count, const IsIn& is_in) {
  constexpr std::size_t kGrain = 256;
  std::vector<std::uint8_t> flags(count, 0);
  parallel_for(count, kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      flags[i] = is_in(i) ? 1 : 0;
  });
  return flags;
}

/// A grid of all of the places.
/// @param cell side of its cubes, model units, positive
[[nodiscard]] PointGrid grid_of(std::span<const Vec3> places, double cell);

/// The points within `radius` of one of the places, in their order.
[[nodiscard]] std::vector<Vec3> points_near(std::span<const Vec3> points, const PointGrid& places,
                                            double radius);

/// The same of the points of a cloud, in the order of its cells.
[[nodiscard]] std::vector<Vec3> points_near(const PointGrid& cloud, const PointGrid& places,
                                            double radius);

/// For each of the points the number of the first one that lies in the same cube.
/// @param side of the cubes, model units, positive
[[nodiscard]] std::vector<std::uint32_t> firsts_of_cubes(std::span<const Vec3> points, double side);

/// The faces whose first corner lies within `radius` of one of the places.
[[nodiscard]] FacePart part_near(const TriangleMesh& mesh, const PointGrid& places, double radius);

}  // namespace rangezip
