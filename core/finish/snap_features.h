#pragma once

#include <cstddef>

#include "core/base/progress.h"
#include "core/finish/point_grid.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

struct SnapOptions {
  double pixel_size = 0.0;  ///< h, model units; positive
};

struct SnapReport {
  std::size_t snapped_vertices = 0;
  std::size_t collapsed_edges = 0;
  std::size_t flipped_edges = 0;
};

/// Restores sharp edges and corners that sampling rounded off: a vertex near which the cloud is no
/// plane moves to where the planes of the clean regions around it meet, the minimum of their
/// quadric [Kobbelt, Botsch, Schwanecke, Seidel 2001, 4]; then edges are turned to run along the
/// feature, and the slivers that arise are removed. A vertex stays where it is unless the points of
/// the cloud next to the new place lie on the planes that meet there: so rounded edges, curved
/// places and noisy clouds are left alone. May leave self-intersections.
/// Cost: linear; points and vertices are visited in parallel.
/// @param cloud without points nothing happens
/// @pre oriented, manifold (core/finish/clean_topology.h)
SnapReport snap_features(TriangleMesh& mesh, const PointGrid& cloud, const SnapOptions& options,
                         const Progress& progress = {});

}  // namespace rangezip
