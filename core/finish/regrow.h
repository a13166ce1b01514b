#pragma once

#include <cstddef>
#include <span>

#include "core/base/progress.h"
#include "core/finish/point_grid.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// Grows a surface over places that no scan has reached: deep in slots, and the walls of holes
/// between what views see of them. Where points are left out (core/finish/left_out_points.h, by
/// more than h), borders go out over the cloud (core/finish/extend_border.h) in steps of at most h,
/// up to 4 h from such points. So the way there leads over the surface, not through the air, and
/// what is left of holes can be closed. Only faces within 8 h of the points are looked at. Fewer
/// than 40 such points are a few pixels: then nothing is done.
///
/// Noise would feather the borders; the cloud should be clean.
/// @param points the cloud
/// @param grid of the same points
/// @param pixel_size h, model units; positive
/// @return steps taken
/// @pre oriented, manifold; stays so. Faces that come cross none.
std::size_t regrow(TriangleMesh& mesh, std::span<const Vec3> points, const PointGrid& grid,
                   double pixel_size, const Progress& progress = {});

}  // namespace rangezip
