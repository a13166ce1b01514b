#pragma once

#include "core/finish/point_grid.h"
#include "core/finish/share_field.h"
#include "core/finish/surface_fit.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// Finds where the surface is so even that more points can be taken together than elsewhere, and
/// where it bends so much that it must be fewer: around each place the radius, from half of the
/// window's to twice as much, at which the squared error of the fits there, bias and variance taken
/// together, is least, or a larger one at which it is hardly more. The bias is told from how far
/// wide fits lie from narrow ones, less what noise alone would make of that, on average over some
/// 10 h [Hausman 1978]. Every fourth vertex is asked.
/// @param window the radius for the whole mesh, and the noise, which must be positive
/// @param pixel_size h, model units
/// @pre oriented, manifold, within about h of the cloud; the cloud is not thinned
/// Cost: seven fits for each vertex that is asked, in parallel.
[[nodiscard]] ShareField local_fit_radii(const TriangleMesh& mesh, const PointGrid& cloud,
                                         const SurfaceWindow& window, double pixel_size);

}  // namespace rangezip
