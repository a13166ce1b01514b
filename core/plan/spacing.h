#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/base/geometry.h"
#include "core/scene/scene.h"

namespace rangezip {

/// How densely a cloud samples its surface.
struct Spacing {
  double median = 0.0;      ///< 1 / sqrt(density), model units
  double quantile75 = 0.0;  ///< three quarters of the cloud are at least this dense
  double sparse = 0.0;      ///< nine tenths of the surface are at least this dense, about
  double gap = 0.0;         ///< between contours, if the cloud is made of such; else 0
  double line_gap = 0.0;  ///< between scan lines, if there are such (core/plan/line_gap.h); else 0
  double near_noise = 0.0;  ///< median distance (RMS) of points from their neighbours' plane
  double noise = 0.0;       ///< the same of all points as near as the noise is wide
  double diagonal = 0.0;    ///< of robust_bounds(), model units
};

/// Estimates the spacing from the distance to the 16th neighbour of up to 300 points spread evenly
/// over the cloud: d16 * sqrt(pi / 16), that is, as if those 16 filled a disc. Points at exactly
/// one place count once, both as neighbours and as the points that are asked about. Exact
/// neighbours by a scan over all points that asks few of these per point: O(points), 50 ns each.
/// Where points are sparse each of them stands for more of the surface: for as much as its squared
/// spacing; one off the surface, as outliers are, stands for none, nor does the sparsest one in a
/// hundred, which may be an outlier that nothing tells. Of a scan that is far sparser than another
/// one beside it those 300 hold too few: 300 more are spread over the surface
/// (core/plan/places_over_surface.h), each of which stands for as much of it, and a quarter of them
/// that is sparser tells as much as a tenth of the surface does. Where hardly any of the sparse
/// ones lies on a plane, they are outliers that fill the space around the object, and tell nothing.
/// A cloud of contours, points dense along slices that are far apart, is told by neighbours that
/// lie on a line: of more than half of those 300 the nearest five do. Its gap is the mean of median
/// and 75 % quantile of how far the slices on both sides are, the farther one, but at most twice as
/// far as the nearer one; its spacings are sqrt(gap * step), `step` from point to point on a slice.
/// The noise is measured against a plane, so curvature counts as noise where the surface bends
/// within a few spacings; what lies on the other side of a wall, at least a spacing thick, does
/// not. Where it is wider than those 16 reach, more points tell it (core/plan/cloud_noise.h).
/// @throws InvalidArgument if fewer than three distinct points are given.
[[nodiscard]] Spacing estimate_spacing(std::span<const Vec3> points);

/// The pixel side at which a cloud's sheet has hardly a gap: 2.2 times the mean of median and 75 %
/// spacing, at least 4 times the noise among neighbours and 2.5 times that of all points, and at
/// least 1.5 gaps between contours.
[[nodiscard]] double closed_sheet_pixel_size(const Spacing& spacing);

/// Whether a tenth of the surface or more is over 1.4 times as sparse as the median: of a cloud of
/// points thrown at random it is 1.2 times, by chance.
[[nodiscard]] bool is_uneven(const Spacing& spacing);

/// The pixel side for the scans of a cloud: that of the closed sheet, but down to 1.3 spacings
/// where the cloud is so sparse that fewer than 250 pixels would lie across it; shape is worth more
/// then than closed pixels. A pixel is no smaller than the gap between contours. Where the sparse
/// tenth of the surface exceeds 1.25 medians it is at least 1.3 spacings and 1.45 times the excess,
/// up to four times as much as else: pixels that show through one side of a wall of sparse points
/// lose the other one. Of scan lines hardly two neighbouring rows of pixels may be empty: it is at
/// least 0.9 of their gap. Of the dense parts finer scans are made later
/// (core/finish/local_sizes.h).
[[nodiscard]] double pixel_size_from_spacing(const Spacing& spacing);

/// A box that leaves out far outliers. Per axis the middle half of the cloud is widened on both
/// sides by four times the middle half's largest side, then further, a side's length
/// at a time, as long as the step before held a thousandth of the cloud (so a mast on a flat ground
/// stays); the box of the points in between. Empty for no points. O(points).
[[nodiscard]] Box robust_bounds(std::span<const Vec3> points);

/// The same for a scene: its clouds taken together without far outliers, its polygons whole.
[[nodiscard]] Box robust_bounds(const Scene& scene);

/// Points spread evenly over the triangles of the scene, each triangle with its share of the area,
/// about `count` in all, for planning views of polygons: every point of the scene's surface has
/// a sample within a few times sqrt(area / count). Empty if the scene has no triangle with area.
[[nodiscard]] std::vector<Vec3> area_samples(const Scene& scene, std::size_t count);

/// How many area_samples() pixels of this side need: eight for each that the scene's triangles
/// fill, at least 20,000 and at most 4 million; 200,000 if pixel_size is 0 (no pixels are known).
[[nodiscard]] std::size_t area_sample_count(const Scene& scene, double pixel_size);

/// Area of all triangles of the scene, model units squared.
[[nodiscard]] double triangle_area(const Scene& scene);

}  // namespace rangezip
