#pragma once

#include <cstddef>

#include "core/base/progress.h"
#include "core/finish/fit_window.h"
#include "core/finish/point_grid.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

struct RemeshOptions {
  double pixel_size = 0.0;    ///< h, model units; positive
  FitWindow fit;              ///< of the surface
  std::size_t triangles = 0;  ///< how many there are to be, met within a few percent; 0: as many as
                              ///< there are
  ShareField sizes;           ///< lengths of edges relative to one another, of equal bending
  int rounds = 7;             ///< fewer than three keep the number of triangles
};

struct RemeshReport {
  std::size_t split_edges = 0;
  std::size_t collapsed_edges = 0;
  std::size_t flipped_edges = 0;
  std::size_t flattened_spikes = 0;
  double edge = 0.0;  ///< length of edges, on average over bending, where the size is one; model
                      ///< units
};

/// Covers the surface with well-shaped triangles, smaller where it bends, whose vertices lie on the
/// surface of the cloud [Botsch, Kobbelt 2004]. Each round splits edges that are too long for their
/// place, collapses those that are too short, turns edges so that inner vertices get six
/// neighbours, flattens spikes (core/finish/spikes.h), moves each inner vertex to the middle of its
/// faces within its tangent plane, and then onto fit_surface(), unless that leads far into the air
/// of a clean cloud; from the third round on onto the last surface that was fitted for the vertex,
/// if that was next to it. Of six rounds or more the first makes larger triangles, so that no
/// pattern of the mesh before stays. The last two rounds only turn edges for better angles and
/// remove small ones by collapses. At the end edges turn to follow the surface's normals. A vertex
/// that splits an edge has the source of one of its ends. But for the spikes nothing is done that
/// turns a face by more than 60 degrees. The topology and the boundary stay; unused vertices
/// remain. May leave self-intersections where sheets are close together. Cost: linear; points and
/// vertices are visited in parallel.
/// @param cloud for telling spikes from tips
/// @param surface to fit to: the cloud, or PointGrid::thinned() where the window is wide; without
///     points nothing is projected, and triangles are of one size
/// @pre oriented, manifold (core/finish/clean_topology.h)
RemeshReport remesh(TriangleMesh& mesh, const PointGrid& cloud, const PointGrid& surface,
                    const RemeshOptions& options, const Progress& progress = {});

}  // namespace rangezip
