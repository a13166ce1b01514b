#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "core/finish/point_grid.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// How near a place of the surface has a point of the cloud: within so many pixel sides or, where
/// points are sparse, so many of their spacings.
struct SupportReach {
  double pixels = 0.0;
  double spacings = 0.0;
};

/// Of the centroids of faces and the middles of their sides: farther from points they lie in the
/// air. Of points thrown at random over a surface one in a thousand places has none as near.
inline constexpr SupportReach kFaceSupport{.pixels = 0.75, .spacings = 1.5};

/// The same where two surfaces 2 h apart must be told, of which h is as little as 1.3 spacings. One
/// in twenty places of a surface has no point as near, so only what can be made again may depend on
/// a single one.
inline constexpr SupportReach kCloseSupport{.pixels = 0.75, .spacings = 1.0};

/// Whether the cloud shows the surface at a place.
/// @param pixel_size h, model units
[[nodiscard]] bool is_supported(const PointGrid& cloud, const Vec3& place, double pixel_size,
                                const SupportReach& reach);

/// The same of the centroid of a face and the middles of its sides.
[[nodiscard]] bool is_supported(const PointGrid& cloud, const TriangleMesh& mesh,
                                const Triangle& face, double pixel_size, const SupportReach& reach);

/// Mean distance of neighbouring points on the surface next to a place, from the 16 around the
/// nearest point; nothing if that is farther than 6 h, or those reach farther.
/// @param pixel_size h, model units
[[nodiscard]] std::optional<double> spacing_near(const PointGrid& cloud, const Vec3& place,
                                                 double pixel_size);

/// Drops the faces that the cloud does not support: the centroid or the middle of a side has no
/// point within 0.75 h. Scans join samples over steps of depth of a few pixels; such faces lie
/// across narrow gaps, and a few of them make a handle. Where points are sparse, the limit is 1.5
/// times the spacing of those next to the face: of points thrown at random over a surface one in a
/// thousand places has none as near as that. Faces with no side over 1.5 h have a corner within the
/// limit, and stay. The mesh stays oriented and manifold, without pieces that hang by a vertex.
/// Without points nothing is dropped. In parallel.
/// @param pixel_size h, model units; positive
/// @return how many went
std::size_t drop_unsupported_faces(TriangleMesh& mesh, std::span<const Vec3> cloud,
                                   double pixel_size);

/// Drops the faces that lie in the air beyond doubt: the centroid has no point within 1.25 h and
/// two spacings. A face or two that a scan made across a step of depth, or a stitch from border to
/// border, are enough to join two bodies, and no handle tells it. Faces over a place that was not
/// measured go, too: the hole is closed again by what tells holes. Mesh and cost as above.
/// @param pixel_size h, model units; positive
/// @return how many went
std::size_t drop_faces_in_air(TriangleMesh& mesh, const PointGrid& cloud, double pixel_size);

}  // namespace rangezip
