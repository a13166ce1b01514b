#pragma once

#include "core/base/progress.h"
#include "core/finish/fit_window.h"
#include "core/finish/point_grid.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// Moves inner vertices along their normals so that the flat triangles, not only their corners, are
/// as near as can be to the surface of the cloud: the least squares of the distance between the two
/// over the whole mesh. The surface is fitted over the middle of each triangle (fit_surface()),
/// which takes noise out and tells how far it bulges over the triangle. The linear system has the
/// mass matrix of piecewise linear functions, and a few damped steps solve it, each of them local.
/// A vertex stays if a face would turn by more than 60 degrees. The topology and the boundary stay.
/// Cost: a fit a triangle, in parallel.
/// @param surface the cloud, or PointGrid::thinned() where the window is wide
/// @pre oriented, manifold (core/finish/clean_topology.h)
void fit_vertices(TriangleMesh& mesh, const PointGrid& surface, const FitWindow& fit,
                  const Progress& progress = {});

}  // namespace rangezip
