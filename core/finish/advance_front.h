#pragma once

#include <cstddef>
#include <span>

#include "core/base/progress.h"
#include "core/finish/votes_near.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

struct AdvanceFrontOptions {
  double pixel_size = 0.0;  ///< h, model units; positive
  double apart = 0.6;       ///< in h: of points nearer to each other one is taken
  double max_radius = 0.9;  ///< in h, of the circle through the corners of a face
  /// Of the points around: a face is not made if they look out of its back. Null: not known.
  const VoteGrid* votes = nullptr;
};

/// Grows the border of a mesh over points by an advancing front [Bernardini et al. 1999;
/// Cohen-Steiner, Da 2004]. Each border edge looks for the point, or the vertex of the border, that
/// makes the best face with it: the one with the smallest circle on the far side of the edge, as in
/// a Delaunay triangulation, and that bends least. Of the faces of all edges the smallest and
/// flattest comes first. So fronts that meet are joined, and what is left open has no points.
///
/// No circle has a radius over 0.9 h, so no face leads over a gap of 2 h; with a bend of over 45
/// degrees it has seven ninths of that at most. Faces go on over no sharper bend than 95 degrees,
/// though one that closes other edges may fold over these, as over the edge of a blade; nor do any
/// come that look away from those around a vertex that they join, by over 107 degrees: around a
/// rim they look aside. A face that would cross another gives way to the next best.
///
/// The mesh stays oriented, and its faces stay; the new ones come last. A vertex where fronts have
/// met may be left with several fans (core/finish/clean_topology.h), and points that were not
/// needed are vertices without faces. Cost: a sort of points and border vertices, and for each edge
/// those within 4 h.
/// @param points that the mesh leaves out; border vertices within 2 h of them are joined
/// @return faces that came
/// @pre oriented, manifold
std::size_t advance_front(TriangleMesh& mesh, std::span<const Vec3> points,
                          const AdvanceFrontOptions& options, const Progress& progress = {});

/// Closes what fronts have left open all around: the same without points, from and to the vertices
/// of the border within 2 h of `places`. Each face has its corners on one boundary loop, of 60
/// edges at most, so that no handle comes and no two components are joined. @return faces that came
std::size_t close_fronts(TriangleMesh& mesh, std::span<const Vec3> places,
                         const AdvanceFrontOptions& options, const Progress& progress = {});

}  // namespace rangezip
