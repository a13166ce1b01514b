#pragma once

#include <cmath>
#include <cstddef>

#include "core/base/geometry.h"
#include "core/finish/point_grid.h"

namespace rangezip {

/// Which points around a place are taken for one sheet of the surface.
struct SurfaceWindow {
  double radius = 0.0;  ///< model units, positive
  double height = 0.0;  ///< farther from the tangent plane, points belong to another sheet
  double noise = 0.0;   ///< standard deviation of the points from the surface, model units: bending
                        ///< that it may have made is taken back; 0: all of it is believed
  double widest = 0.0;  ///< radius up to which fit_surface() widens the window where the points do
                        ///< not tell how the surface bends; up to the radius itself: never
};

/// The surface that a cloud shows next to a place, as a quadratic height over the tangent plane.
struct SurfaceFit {
  bool is_found = false;  ///< false: too few points, or they are no surface; nothing else counts
  int count = 0;          ///< points with a weight; of a thinned cloud, its points
  double height = 0.0;    ///< of the surface over the place, along the normal that was given
  Vec3 foot{0.0};         ///< of the place on the surface, along that normal
  Vec3 normal{0.0};       ///< unit, of the surface there; on the side of the given one
  Mat3 bending{0.0};      ///< e^T bending e: how the surface bends away along a tangent vector e,
                          ///< to second order twice the height gained over e
};

/// How much a surface bends, whichever way: the root of the sum of the squared entries.
[[nodiscard]] inline double frobenius_norm(const Mat3& m) {
  return std::sqrt(glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2]));
}

/// Weighted least squares of a quadric z = z(u, v) over the plane through `place` across `normal`
/// [Cazals, Pouget 2005]; weights fall to 0 at the radius. With few points a plane is fitted, with
/// fewer than six nothing. Points that are known to face away (PointGrid::note_facings()) do not
/// count. Cost: the points within the radius, which may be widened.
/// @pre normal is a unit vector
[[nodiscard]] SurfaceFit fit_surface(const PointGrid& cloud, const Vec3& place, const Vec3& normal,
                                     const SurfaceWindow& window);

/// A place on the fitted surface, or near it, moved onto it across the tangent plane at the foot;
/// exact to second order, for places much nearer to the foot than the window is wide.
/// @pre is_found
[[nodiscard]] Vec3 projected_onto(const SurfaceFit& fit, const Vec3& place);

/// What noise does to a fit.
struct SurfaceScatter {
  double noise2 = 0.0;  ///< mean square distance of points from the surface, unbiased
  double share2 = 0.0;  ///< sum of the squared shares of the points in the height: noise2 times
                        ///< this is its variance
};

struct MeasuredFit {
  SurfaceFit fit;
  SurfaceScatter scatter;
};

/// The same with its scatter, for twice the cost. @pre the cloud is not thinned
[[nodiscard]] MeasuredFit measure_surface(const PointGrid& cloud, const Vec3& place,
                                          const Vec3& normal, const SurfaceWindow& window);

/// The covariance of the heights of two fits at a place, as a multiple of the variance of the wider
/// one: 1 for the same radius, towards 1.4 for a much narrower one. It follows from the weights,
/// for points all around that are spread evenly.
[[nodiscard]] double fit_covariance(double narrow_radius, double wide_radius);

}  // namespace rangezip
