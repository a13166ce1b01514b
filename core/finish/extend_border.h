#pragma once

#include <cstddef>

#include "core/base/progress.h"
#include "core/finish/point_grid.h"
#include "core/finish/small_pieces.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

struct ExtendBorderOptions {
  double pixel_size = 0.0;        ///< h, model units; positive
  std::size_t min_component = 0;  ///< pieces with fewer faces that cutting leaves are dropped
  double smallest_angle = 0.0;    ///< sine: no step makes a smaller one
  int max_rounds = 300;           ///< of one step at each border edge that needs one, at most
};

struct ExtendBorderReport {
  std::size_t steps = 0;           ///< that were taken
  std::size_t reverted_steps = 0;  ///< that were taken back: faces would have crossed
  std::size_t edges_left = 0;      ///< border edges that points of the cloud still lie beyond
  DroppedComponents dropped;       ///< pieces that cutting left
};

/// Brings the border of an open surface out to where the points of the cloud end: scans end at the
/// centres of pixels, up to a pixel inside of the data's edge, and more where nothing could be
/// stitched. In each round every border edge that points lie beyond (core/finish/border_gaps.h)
/// at most h away takes one step to the farthest of them, the one that makes the best triangles
/// (core/finish/border_step.h). One that turns a face too far or makes a needle is not taken, one
/// that lets faces cross is taken back; then the next best is tried, and when none is left the
/// edge's face is cut away, with more of its neighbours each time that it is the same point.
/// Without self-intersections before there are none after; the surface stays manifold and oriented;
/// a mesh without border, or without points beyond it, does not change.
/// Cost: some linear passes over the mesh a round; rounds end when nothing is left to do, or the
/// border has three times as many edges as at first.
/// @param cloud without points nothing happens
/// @throws Cancelled if `progress` says so.
/// @pre oriented, manifold (core/finish/clean_topology.h)
ExtendBorderReport extend_border(TriangleMesh& mesh, const PointGrid& cloud,
                                 const ExtendBorderOptions& options, const Progress& progress = {});

}  // namespace rangezip
