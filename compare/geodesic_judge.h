#pragma once

#include <span>
#include <vector>

#include "compare/surface_path.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip::compare {

/// A path over a mesh beside the shortest one between its ends; model units.
struct GeodesicMatch {
  double line = 0.0;       ///< length of the path as it is given
  double length = 0.0;     ///< of the shortest path through its faces
  double shortest = 0.0;   ///< of the shortest path of all
  double deviation = 0.0;  ///< of these two: largest distance of a corner of either from the other
  bool is_judged = false;  ///< false: CGAL found no way, or none as short as the given one: the
                           ///< faces are too bad for its floating-point unfolding
};

/// Judges each path by CGAL's Surface_mesh_shortest_path [Xin, Wang 2009]: on its own faces alone,
/// and on those that a path of its length from its start can reach, which cannot miss the shortest
/// one. For what cuts a mesh by flipping edges the faces are what is decided: a segment that has
/// become an edge has left no point on the edges that it crossed. O(the square of these faces) a
/// path.
/// @throws InvalidArgument if a face is not of the mesh, or a path has no face or not one point
///     more than faces; TopologyError if a corner index of the mesh is out of range or a used
///     position not finite.
[[nodiscard]] std::vector<GeodesicMatch> judge_geodesics(const TriangleMesh& mesh,
                                                         std::span<const SurfacePath> paths);

}  // namespace rangezip::compare
