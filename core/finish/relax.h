#pragma once

#include <cstddef>

#include "core/base/progress.h"
#include "core/finish/point_grid.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

struct RelaxOptions {
  double pixel_size = 0.0;  ///< h, model units; positive
  int rounds = 5;
};

struct RelaxReport {
  std::size_t collapsed_edges = 0;
  std::size_t flipped_edges = 0;
  std::size_t flattened_spikes = 0;
};

/// Evens out triangles without leaving the cloud. Each round collapses edges shorter than h/2,
/// flips edges where the smallest angle grows, flattens spikes (core/finish/spikes.h), moves each
/// inner vertex half-way to the middle of its neighbours within its tangent plane, and then onto
/// the plane through the points of the cloud within 1.3 h (2.1 h where those are few), by at most
/// about half that. But for the spikes nothing is done that turns a face by more than 60 degrees.
/// The topology and the boundary stay; unused vertices remain. May leave self-intersections where
/// sheets are close together. Cost: linear; points and vertices are visited in parallel.
/// @param cloud without points nothing is projected
/// @pre oriented, manifold (core/finish/clean_topology.h)
RelaxReport relax(TriangleMesh& mesh, const PointGrid& cloud, const RelaxOptions& options,
                  const Progress& progress = {});

}  // namespace rangezip
