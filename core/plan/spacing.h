#pragma once

#include <span>

#include "core/base/geometry.h"
#include "core/scene/scene.h"

namespace rangezip {

/// How densely a cloud samples its surface.
struct Spacing {
  double median = 0.0;     ///< 1 / sqrt(density), model units
  double quantile75 = 0.0; ///< three quarters of the cloud are at least this dense
  double noise = 0.0;      ///< median distance of a point from its neighbours' plane, model units
};

/// Estimates the spacing from the distance to the 16th neighbour of 300 points spread evenly over
/// the cloud: d16 * sqrt(pi / 16). Exact neighbours by a linear scan: O(300 points).
/// @throws InvalidArgument if fewer than three distinct points are given.
[[nodiscard]] Spacing estimate_spacing(std::span<const Vec3> points);

/// A box that leaves out far outliers: the box of the points that remain when those are cut that
/// lie farther from the middle half of the cloud than a few times its size, per axis. O(points).
[[nodiscard]] Box robust_bounds(std::span<const Vec3> points);

/// The pixel side for a cloud: 2.2 times the mean of median and 75 % spacing, at least 4 noise.
[[nodiscard]] double pixel_size_from_spacing(const Spacing& spacing);

/// Points spread evenly over the triangles of the scene (stratified by area, deterministic), about
/// `count`, for planning views of polygons. Empty if the scene has no triangles.
[[nodiscard]] std::vector<Vec3> area_samples(const Scene& scene, std::size_t count);

/// Area of all triangles of the scene, model units squared.
[[nodiscard]] double triangle_area(const Scene& scene);

}  // namespace rangezip
