#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/geometry.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip::compare {

/// Where a point is nearest to a mesh.
struct NearestFace {
  std::uint32_t face = 0;  ///< index of the triangle; of several equally near ones any
  double distance = 0.0;   ///< model units
};

/// The nearest face of `mesh` for each point, by CGAL's AABB tree. Faces without area are left
/// out: their neighbours are as near. O((faces + points) log faces).
/// @throws InvalidArgument if a point is not finite.
/// @throws TopologyError if the mesh has no face with an area, or a corner that is out of range or
///     not finite.
[[nodiscard]] std::vector<NearestFace> nearest_faces(std::span<const Vec3> points,
                                                     const TriangleMesh& mesh);

/// The face of `mesh` that the straight line through each point meets nearest to it, before or
/// behind, and the distance along the line; none where it meets no face.
/// @param directions of the lines, one a point, not zero
/// @throws as nearest_faces(), and InvalidArgument if there is not one direction a point
[[nodiscard]] std::vector<std::optional<NearestFace>> nearest_faces_along(
    std::span<const Vec3> points, std::span<const Vec3> directions, const TriangleMesh& mesh);

/// The distances alone.
[[nodiscard]] std::vector<double> distances_to_mesh(std::span<const Vec3> points,
                                                    const TriangleMesh& mesh);

/// A set of distances in figures, model units; all zero for an empty set.
struct DistanceSummary {
  std::size_t count = 0;
  double mean = 0.0;
  double rms = 0.0;
  double p95 = 0.0;  ///< the smallest distance that 95 % do not exceed
  double max = 0.0;
};

[[nodiscard]] DistanceSummary summarize(std::span<const double> distances);

/// The smallest of the values that so many percent of them do not exceed; 0 for an empty set.
/// @pre 0 < percent <= 100
[[nodiscard]] double percentile(std::vector<double> values, std::size_t percent);

/// Share of the distances that are at most `limit`; 1 for an empty set.
[[nodiscard]] double share_within(std::span<const double> distances, double limit);

struct SurfaceSampleOptions {
  std::size_t count = 200'000;
  std::uint64_t seed = 1;
};

/// Points spread evenly over the area of a mesh: one in each of `count` strips of equal area, at a
/// place that the seed decides. The same everywhere for the same seed.
/// @throws TopologyError if the mesh has no area, or a corner out of range or not finite.
[[nodiscard]] std::vector<Vec3> sample_surface(const TriangleMesh& mesh,
                                               const SurfaceSampleOptions& options = {});

}  // namespace rangezip::compare
