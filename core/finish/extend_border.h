#pragma once

#include <cstddef>

#include "core/base/progress.h"
#include "core/finish/point_grid.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

struct ExtendBorderOptions {
  double pixel_size = 0.0;  ///< h, model units; positive
  int rounds = 3;           ///< of moving every border vertex
};

struct ExtendBorderReport {
  std::size_t moves = 0;           ///< of a vertex, in all rounds
  std::size_t reverted_moves = 0;  ///< in part or in full: faces would have crossed
};

/// Moves the border of an open surface out to where the points of the cloud end: scans end at the
/// centres of pixels, up to a pixel inside of the data's edge. A border vertex moves along the
/// surface, away from its faces, until the border passes the farthest point that lies beyond one of
/// its two border edges, and onto the plane of the points there. A point counts if it is at most
/// h beyond, near the plane of the edge's face, nearer to the edge than to other parts of the mesh,
/// and not alone. A move that would turn a face, make a sliver or let faces cross is not done.
/// Without self-intersections before there are none after. Topology stays; a mesh without border
/// does not change.
/// Cost: linear; border vertices are visited in parallel.
/// @param cloud without points nothing happens
/// @pre oriented, manifold (core/finish/clean_topology.h)
ExtendBorderReport extend_border(TriangleMesh& mesh, const PointGrid& cloud,
                                 const ExtendBorderOptions& options, const Progress& progress = {});

}  // namespace rangezip
