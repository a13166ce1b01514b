#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/finish/corner_table.h"
#include "core/finish/face_grid.h"
#include "core/finish/point_grid.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// The point of a cloud that lies farthest beyond a border edge.
struct BorderGap {
  std::uint32_t corner = 0;  ///< of the half-edge at the border
  Vec3 point{0.0};           ///< world
  double share = 0.0;        ///< of the edge up to the point's foot, 0 to 1
  double beyond = 0.0;       ///< outward in the plane of the edge's face, model units
  double height = 0.0;       ///< over that plane, model units, signed
  Vec3 outward{0.0};         ///< unit
  Vec3 normal{0.0};          ///< unit, of the face
};

/// The border half-edges before and after a border half-edge.
[[nodiscard]] std::uint32_t border_before(const CornerTable& table, std::uint32_t corner);
[[nodiscard]] std::uint32_t border_after(const CornerTable& table, std::uint32_t corner);

struct BorderGapOptions {
  double reach = 0.0;       ///< points farther from the border do not count, model units
  double negligible = 0.0;  ///< nor those that are less beyond, model units
};

/// For each border edge the worst point of the cloud that lies beyond it: the place of the mesh
/// nearest to the point is on this edge, and the point is outward of it in the plane of its face
/// (at a corner of the border: of one of the two). In the order of corners; edges without such
/// points have no entry. Where the data ends, so does the mesh, if there is none at all. Cost:
/// linear in the border and the points near it; in parallel.
/// @param faces of the mesh as it is, with at least this reach
[[nodiscard]] std::vector<BorderGap> find_border_gaps(const TriangleMesh& mesh,
                                                      const CornerTable& table,
                                                      const FaceGrid& faces, const PointGrid& cloud,
                                                      const BorderGapOptions& options);

/// The same for some of the border edges.
/// @param border their half-edges, without a face across
[[nodiscard]] std::vector<BorderGap> find_border_gaps(const TriangleMesh& mesh,
                                                      const CornerTable& table,
                                                      const FaceGrid& faces, const PointGrid& cloud,
                                                      std::span<const std::uint32_t> border,
                                                      const BorderGapOptions& options);

}  // namespace rangezip
