#pragma once

#include "core/finish/point_grid.h"
#include "core/finish/share_field.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// How much smaller than a pixel triangles may be where the cloud is denser than elsewhere, down to
/// a quarter: what a pixel would be that is chosen for that place alone, 2.2 times the spacing of
/// the points there and at least four times their noise. Places where that is not clearly smaller
/// than a pixel, less than 0.6 of it, have a share of 1. [Kobbelt, Botsch 2000, Fig. 3] shows two
/// such resolutions. The density is that of points next to the mesh, within a pixel side of every
/// fourth vertex, on average over cubes of two pixel sides and what touches them.
/// @param pixel_size h of the scans, model units; positive
/// @param noise standard deviation of the points from the surface, model units
/// @pre oriented, manifold
/// Cost: the points within h for each vertex that is asked, in parallel.
[[nodiscard]] ShareField local_sizes(const TriangleMesh& mesh, const PointGrid& cloud,
                                     double pixel_size, double noise);

}  // namespace rangezip
