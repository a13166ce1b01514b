#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/base/geometry.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// In h: how far from the mesh points are left out. A membrane in the middle of a gap of 2 h is 1 h
/// from its walls.
inline constexpr double kLeftOut = 0.7;
inline constexpr std::size_t kFewLeftOut = 40;  ///< fewer do not matter

/// The points of places that a mesh leaves out: those farther from it than `distance`, as are at
/// least half of the points within twice that around them. The tails of noise, of which a few lie
/// far from any good surface but all around lies what is near, are not among them. Where more
/// than 64 of them lie in a cube with sides of a quarter of the distance, the first tells for all.
/// In the order of the points. O(points + faces), in parallel.
/// @param distance model units, positive
[[nodiscard]] std::vector<Vec3> left_out_points(std::span<const Vec3> points,
                                                const TriangleMesh& mesh, double distance);

/// The same, where the points are known that are farther from the mesh.
[[nodiscard]] std::vector<Vec3> left_out_points(std::span<const Vec3> points,
                                                const std::vector<Vec3>& farther,
                                                const TriangleMesh& mesh, double distance);

}  // namespace rangezip
