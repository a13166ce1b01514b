#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/geometry.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip::compare {

/// How well a point location, such as the correspondence of a scan's samples, did against the
/// nearest faces by CGAL's AABB tree.
struct LocationVerdict {
  std::size_t points = 0;     ///< given
  std::size_t unlocated = 0;  ///< with the face kNoPrimitive
  std::size_t agreeing = 0;   ///< whose face is as near as the nearest one
  double mean_loss = 0.0;     ///< how much farther the given face is, over located points
  double max_loss = 0.0;      ///< both in model units

  /// Share of the located points that agree; 1 if there are none.
  [[nodiscard]] double agreement() const noexcept {
    const std::size_t located = points - unlocated;
    return located == 0 ? 1.0 : static_cast<double>(agreeing) / static_cast<double>(located);
  }
};

/// Judges faces[i] as the face of `mesh` nearest to points[i]. A face counts as nearest if it is no
/// farther than 1e-12 of the mesh's diagonal beyond the nearest one: faces that share the nearest
/// edge or vertex are equally right and differ by rounding only.
/// @throws InvalidArgument if the two spans differ in length, a face index is neither of the mesh
///     nor kNoPrimitive, or a point is not finite.
/// @throws TopologyError as nearest_faces().
[[nodiscard]] LocationVerdict judge_location(const TriangleMesh& mesh, std::span<const Vec3> points,
                                             std::span<const PrimitiveId> faces);

}  // namespace rangezip::compare
