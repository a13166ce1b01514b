#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "core/base/geometry.h"
#include "core/scene/scene.h"

namespace rangezip {

/// What an automatic run decides about the size of things before it scans.
struct Resolution {
  double pixel_size = 0.0;  ///< model units
  /// Whether places with more points may have finer pixels: these are no coarser than the points
  /// ask for, and not given, and the points are not of scan lines, whose holes no number tells.
  bool follows_density = false;
  int point_size = 1;    ///< pixels: larger than 1 where the pixel is finer than the spacing
  double spacing = 0.0;  ///< of points, the median, model units; 0: there are polygons only
  double noise = 0.0;    ///< of points along the normal, model units
  double gap = 0.0;      ///< between contours, model units; 0: the points are spread evenly
  Box bounds;            ///< of the object, without far outliers
};

/// Chooses the pixel side: as given; else from the point spacing (pixel_size_from_spacing()), or
/// for polygons only so that they get about 100 K triangles; finer if `triangles` are more than
/// that gives. For fewer, the scans stay finer than the mesh that is made of them, down to an
/// eighth of the pixel side, if that mesh `is_remeshed`; else the pixel is as large as the
/// triangles demand. Of an uneven cloud, if that mesh `is_remeshed`, it is no finer than its own,
/// unless the finish could not split its faces into so many. Never so fine that an image outgrows
/// the rasterizer.
/// @param samples the points of the scene, in its order, then area samples of its polygons
/// @param excess how many times as many triangles as `triangles` are expected to come of the pixels
///     that this chooses; 1: unknown
/// @throws InvalidArgument for a pixel side or a target that is not positive, and for a target of
///     more triangles than pixels of a quarter of the point spacing give, or the finest images.
[[nodiscard]] Resolution choose_resolution(const Scene& scene, std::span<const Vec3> samples,
                                           std::optional<double> pixel_size,
                                           std::optional<std::size_t> triangles, bool is_remeshed,
                                           double excess = 1.0);

}  // namespace rangezip
