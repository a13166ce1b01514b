#pragma once

#include "core/finish/point_grid.h"
#include "core/finish/share_field.h"
#include "core/finish/surface_fit.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// How much of a cloud is taken together for one place of the surface.
struct FitWindow {
  SurfaceWindow window;
  double noise = 0.0;  ///< standard deviation of the points from the surface, model units
  ShareField radii;    ///< by how much the window is wider or narrower at a place

  /// The window for fits at a place, or one with a multiple of its radius.
  [[nodiscard]] SurfaceWindow at(const Vec3& place, double times = 1.0) const;
};

/// Chooses the window in proportion to what the samples show: the radius at which the squared error
/// of the fitted surface is least, its bending between the points (bias) and their scatter
/// (variance) taken together, or a larger one at which it is hardly more, for smoother normals.
/// Both are estimated without knowing the surface: the noise from the residuals of the narrowest
/// fits, the error of a wider fit from how far it lies from the narrowest one, less what noise
/// alone would make of that [Hausman 1978]. About 2,000 vertices are asked.
/// @param pixel_size h, model units; radii are 1.3 to 4.6 h
/// @pre oriented, manifold (core/finish/clean_topology.h), within about h of the cloud
[[nodiscard]] FitWindow choose_fit_window(const TriangleMesh& mesh, const PointGrid& cloud,
                                          double pixel_size);

}  // namespace rangezip
