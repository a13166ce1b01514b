#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/base/progress.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// All pairs of triangles (lower index first, sorted) that cross, overlap, or touch other than in
/// the vertex or edge they share: neighbours count only if they fold onto or pass through each
/// other (core/mesh/triangle_overlap.h). A triangle without area pairs with itself, {i, i}, and
/// with no other. Exact: decided by signs of determinants computed without error. The same verdict
/// as CGAL's Polygon_mesh_processing::self_intersections.
/// Cost: a uniform grid over the triangles, about linear for meshes of even size; where it tells
/// too few of them apart, as slivers across the axes, that of core/mesh/crowded_triangles.h.
/// @throws Cancelled if `progress` says so.
[[nodiscard]] std::vector<std::pair<std::uint32_t, std::uint32_t>> self_intersections(
    const TriangleMesh& mesh, const Progress& progress = {});

/// The same, only pairs with at least one triangle of `changed` (indices, any order). But for one
/// look at every triangle, the cost is that of the triangles near the changed ones.
/// @param apart those of the changed ones that are known not to meet each other, as the triangles
/// of
///     one range image; they are compared with all others
/// @throws Cancelled if `progress` says so.
[[nodiscard]] std::vector<std::pair<std::uint32_t, std::uint32_t>> self_intersections(
    const TriangleMesh& mesh, std::span<const std::uint32_t> changed,
    std::span<const std::uint32_t> apart = {}, const Progress& progress = {});

}  // namespace rangezip
