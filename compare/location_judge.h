#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/geometry.h"
#include "core/mesh/triangle_mesh.h"
#include "core/view/view.h"

namespace rangezip::compare {

/// A point whose face is not the nearest one.
struct WrongFace {
  std::size_t point = 0;  ///< its index
  PrimitiveId given = 0;
  PrimitiveId nearest = 0;
  double loss = 0.0;  ///< how much farther the given face is, model units
};

/// How well a point location, such as the correspondence of a scan's samples, did against the
/// nearest faces by CGAL's AABB tree.
struct LocationVerdict {
  std::size_t points = 0;        ///< given
  std::size_t unlocated = 0;     ///< with the face kNoPrimitive
  std::size_t missed = 0;        ///< of those: a face was there (count_missed(), if it was asked)
  std::size_t agreeing = 0;      ///< whose face is as near as the nearest one
  std::size_t close = 0;         ///< of those that do not agree: at most the slack farther
  double mean_loss = 0.0;        ///< how much farther the given face is, over located points
  double max_loss = 0.0;         ///< both in model units
  std::vector<WrongFace> wrong;  ///< those that do not agree, by point

  /// Share of the located and missed points that agree; 1 if there are none.
  [[nodiscard]] double agreement() const noexcept { return share(agreeing); }
  /// Share of them whose face is right or nearly so; 1 if there are none.
  [[nodiscard]] double acceptance() const noexcept { return share(agreeing + close); }

 private:
  [[nodiscard]] double share(std::size_t count) const noexcept {
    const std::size_t judged = points - unlocated + missed;
    return judged == 0 ? 1.0 : static_cast<double>(count) / static_cast<double>(judged);
  }
};

/// Judges faces[i] as the face of `mesh` nearest to points[i]. A face counts as nearest if it is no
/// farther than 1e-12 of the mesh's diagonal beyond the nearest one: faces that share the nearest
/// edge or vertex are equally right and differ by rounding only.
/// @param slack how much farther than the nearest face one may be that still counts as close
/// @throws InvalidArgument if the two spans differ in length, a face index is neither of the mesh
///     nor kNoPrimitive, or a point is not finite.
/// @throws TopologyError as nearest_faces().
[[nodiscard]] LocationVerdict judge_location(const TriangleMesh& mesh, std::span<const Vec3> points,
                                             std::span<const PrimitiveId> faces,
                                             double slack = 0.0);

/// Judges faces[i] as the face of `mesh` in the line of sight of points[i] that is nearest to it
/// there, before or behind, by CGAL's AABB tree. A line may pass beside its face by rounding; the
/// gap counts as distance. Where the tree finds no face in the line, only that gap counts.
/// @throws as judge_location()
[[nodiscard]] LocationVerdict judge_location_in_sight(const TriangleMesh& mesh, const View& view,
                                                      std::span<const Vec3> points,
                                                      std::span<const PrimitiveId> faces,
                                                      double slack = 0.0);

/// How many of the points whose face is kNoPrimitive have one after all: of the faces that their
/// line of sight meets the nearest looks at the viewer, is at most `distance` (model units) away,
/// and is not met at its end: within a thirtieth of `distance` of an edge that no other face has.
/// @throws as judge_location()
[[nodiscard]] std::size_t count_missed(const TriangleMesh& mesh, const View& view,
                                       std::span<const Vec3> points,
                                       std::span<const PrimitiveId> faces, double distance);

}  // namespace rangezip::compare
