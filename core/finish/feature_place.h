#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <vector>

#include "core/base/geometry.h"
#include "core/finish/feature_sides.h"
#include "core/finish/point_grid.h"

namespace rangezip {

/// In h: so near points lie to the sides that they prove, root mean square beyond the noise.
inline constexpr double kProofTolerance = 0.06;

/// A place and the sides of features around it, relative to it. At most five are looked at.
struct Surroundings {
  const PointGrid& cloud;
  double pixel_size = 0.0;  ///< h, model units; positive
  double radius = 0.0;      ///< in which points are asked, model units
  double noise2 = 0.0;      ///< mean square distance of points from the surface
  Vec3 origin{0.0};         ///< the place
  std::vector<FeatureSide> sides;
  double tolerance = kProofTolerance;  ///< h, in its place
};

/// Where a vertex near a feature belongs.
struct FeaturePlace {
  std::size_t count = 0;  ///< of sides that meet there: 1 on a side, 2 on an edge, 3 at a corner;
                          ///< 0: nowhere that could be proved
  Vec3 place{0.0};        ///< relative to the origin
  std::array<std::size_t, 3> sides{};  ///< indices of these sides
};

/// The nearest corner if it is closer than 0.8 `edge`, the nearest edge if it is closer than half
/// of it, else the place on the nearer of the two sides that meet there; with one side only, the
/// place on it, if that is within 2.5 h and the points are off a smooth surface by 0.2 h or more
/// (root mean square). A place counts only if the
/// points of the cloud around it lie on the sides, some on each that meets there, much closer than
/// on a smooth surface, and if it lies on no side beyond where that ends at another, be that only a
/// little bent from it.
/// @param edge mean length of the edges around the origin, model units
/// @param smooth_residual2 mean square distance of the points from a smooth surface
[[nodiscard]] FeaturePlace find_feature_place(const Surroundings& around, double edge,
                                              double smooth_residual2);

/// The mean square distance of the points around a place from the nearest side; nothing where they
/// do not lie on the sides, or only few on one of those that are said to meet there.
[[nodiscard]] std::optional<double> residual2_of_sides(const Surroundings& around,
                                                       const Vec3& place,
                                                       std::initializer_list<std::size_t> meeting);

/// Whether two sides are too much alike to make a feature: they differ by less than 30 degrees.
[[nodiscard]] bool is_one_side(const FeatureSide& a, const FeatureSide& b);

}  // namespace rangezip
