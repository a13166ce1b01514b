#pragma once

#include <optional>
#include <span>

#include "core/finish/point_grid.h"

namespace rangezip {

/// What the points around a place tell of the surface there.
struct LocalPlane {
  Vec3 foot{0.0};          ///< of the place on the plane through them
  Vec3 normal{0.0};        ///< of unit length, to one side or the other
  Vec3 tangent{0.0};       ///< of unit length, in the plane
  double thickness = 0.0;  ///< RMS distance of the points from the plane, model units
};

/// The plane through the points within `radius` of a place; nothing if there are under six.
[[nodiscard]] std::optional<LocalPlane> plane_at(const Vec3& place, const PointGrid& cloud,
                                                 double radius);

/// In h: around a place, in which the points tell its plane.
inline constexpr double kPlaneRadius = 1.3;

/// The noise of a cloud against planes of kPlaneRadius, as some of its points show it, a thousand
/// at most: of these the thinnest quarter tells, since at creases and where two walls are close
/// clean points lie on no plane. 0 without points.
/// @param pixel_size h, model units
/// @return standard deviation, model units
[[nodiscard]] double noise_of(std::span<const Vec3> points, const PointGrid& cloud,
                              double pixel_size);

}  // namespace rangezip
