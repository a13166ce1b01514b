#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/progress.h"
#include "core/finish/fit_window.h"
#include "core/finish/point_grid.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

struct SnapOptions {
  double pixel_size = 0.0;  ///< h, model units; positive
  FitWindow fit;            ///< of the cloud: its noise, and the radius that noise demands
  ShareField sizes;         ///< of triangles, in h: where they are smaller, they take its place
  double edge = 0.0;        ///< mean length, model units, where the size is one: if it is shorter
                            ///< than scans make it, so is what counts as too short; 0: it is not
  std::vector<std::uint8_t> is_kept;  ///< vertices that stay where they are, with the edges that
                                      ///< end there; empty: none
};

struct SnapReport {
  std::size_t snapped_vertices = 0;  ///< now on features
  std::size_t split_edges = 0;       ///< at a feature that they crossed
  std::size_t collapsed_edges = 0;
  std::size_t flipped_edges = 0;
};

/// Restores sharp edges and corners that sampling rounded off. A vertex near which the cloud is no
/// smooth surface moves to where the surfaces of the clean regions around it meet [Kobbelt, Botsch,
/// Schwanecke, Seidel 2001, 4], or, if that is farther than half an edge, onto the nearer of these
/// surfaces (feature_place.h); where there is one only, and no surface around the vertex itself,
/// onto that; of a mesh without any edge all of it is taken back. Between edges under 3 h apart the
/// nearest points tell the surfaces, where there is hardly noise and they hardly bend. Where that
/// fails the surfaces are fitted to the points (refit_sides.h), and next to features also with
/// theirs. Edges that then still cross a feature are split there, and faces that cut a corner off.
/// Edges are turned to run along the feature, slivers that arise are removed, and the triangles
/// along the feature evened out (relax_features.h). A vertex stays where it is unless the points of
/// the cloud next to the new place lie on the surfaces that meet there: so rounded edges and places
/// that cannot be told are left alone; and if it would be on a feature all alone. The surfaces are
/// quadratic (fit_surface()), so edges between curved faces are found as well. May leave
/// self-intersections. Cost: linear; points and vertices are visited in parallel.
/// @param cloud without points nothing happens
/// @pre oriented, manifold (core/finish/clean_topology.h)
SnapReport snap_features(TriangleMesh& mesh, const PointGrid& cloud, const SnapOptions& options,
                         const Progress& progress = {});

}  // namespace rangezip
