#pragma once

#include <span>
#include <vector>

#include "core/base/geometry.h"
#include "core/base/progress.h"
#include "core/mesh/triangle_mesh.h"
#include "core/raster/rasterizer.h"

namespace rangezip {

struct ViewPlanOptions {
  int max_views = 20;
  int candidates = 150;             ///< directions on the sphere, besides the six axes
  std::size_t subset = 60'000;      ///< points used for planning
  double max_slope_cosine = 0.342;  ///< a point is seen well if its surface is tilted less (70
                                    ///< degrees)
  double coverage = 0.999;          ///< stop when this share of the points is seen
  double min_gain = 0.0005;         ///< stop when a view adds less than this share
  int views_for_quality = 6;        ///< so many views may add less, since they see points better
  bool one_sided = false;           ///< only views less than 90 degrees from the first one: an open
                                    ///< sheet is scanned from one side, the upper one (z) if what
                                    ///< it shows is worth 85 % of what the other does
};

/// Directions toward the viewer, best first, and what they reach.
struct ViewPlan {
  std::vector<Vec3> directions;
  std::vector<double> coverage;  ///< share of the subset seen after each view
  double reachable = 0.0;        ///< share that any candidate sees
};

/// Chooses parallel views that together see the cloud well, before any meshing: each candidate
/// draws the subset into a small z-buffer; greedy maximum of the summed sampling quality, where
/// q(view, point) = (cos - cos 70) / (1 - cos 70) for a visible point, gain = q plus a bonus if not
/// yet seen, 0.35 of the improvement else; once such a view adds nothing new, those that do.
/// Far outliers are left out. O(candidates * subset).
/// @param points the cloud, or area samples of polygons
/// @param pixel_size of the scans to come; the planner's own is coarser where the subset is
/// @throws InvalidArgument if there are no points, or pixel_size or an option is out of range.
[[nodiscard]] ViewPlan plan_views(Rasterizer& rasterizer, std::span<const Vec3> points,
                                  double pixel_size, const ViewPlanOptions& options = {},
                                  const Progress& progress = {});

/// The same for some points only, which others hide: parallel views that together see `targets`,
/// such as what earlier views have left out.
/// @param points what hides the targets; the targets are among them
/// @throws InvalidArgument as plan_views(), and if there are no targets.
[[nodiscard]] ViewPlan plan_views_of(Rasterizer& rasterizer, std::span<const Vec3> points,
                                     std::span<const Vec3> targets, double pixel_size,
                                     const ViewPlanOptions& options = {},
                                     const Progress& progress = {});

/// Up to `max_views` directions that look into the boundary loops of `mesh` that are longer than
/// `min_loop` (model units): greedy over the normals of the faces at the loops, in decreasing order
/// of what they may fill (the automatic green lasso). O(faces).
/// @pre the mesh is oriented and manifold
[[nodiscard]] std::vector<Vec3> plan_fill_views(const TriangleMesh& mesh, double min_loop,
                                                int max_views);

}  // namespace rangezip
