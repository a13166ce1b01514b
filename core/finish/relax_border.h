#pragma once

#include "core/base/progress.h"
#include "core/finish/fit_window.h"
#include "core/finish/point_grid.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// Evens out the triangles along the border, whose edges are as long as the end of the cloud asks
/// for: inner vertices within three edges of it move to the middle of their faces and onto the
/// surface of the cloud where that makes better angles, edges turn, and vertices with a small angle
/// are collapsed, as relax_features() does beside features. The border stays, and so do vertices
/// with a crease (30 degrees) among their faces. Without self-intersections before there are none
/// after: what crosses is done again without the vertices around, a few times; if that does not do,
/// nothing changes. The topology stays; unused vertices remain. Cost: linear in the mesh, and fits
/// to the cloud for the vertices along the border.
/// @param surface to fit to: the cloud, or PointGrid::thinned() where the window is wide
/// @return whether anything may have changed; false of a mesh without border
/// @throws Cancelled if `progress` says so.
/// @pre oriented, manifold (core/finish/clean_topology.h)
bool relax_border(TriangleMesh& mesh, const PointGrid& surface, const FitWindow& fit,
                  const Progress& progress = {});

}  // namespace rangezip
