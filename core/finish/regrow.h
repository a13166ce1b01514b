#pragma once

#include <cstddef>
#include <vector>

#include "core/base/progress.h"
#include "core/finish/grow_bodies.h"
#include "core/finish/point_grid.h"
#include "core/finish/seen_points.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// In h: points with a larger spacing leave circles of the front's radius empty by chance; and
/// those with a still larger one do not tell walls that are 2 h apart.
inline constexpr double kSparseSpacing = 0.6;
inline constexpr double kVerySparseSpacing = 0.9;

struct RegrowOptions {
  double pixel_size = 0.0;  ///< h, model units; positive
  double in_the_way = 0.9;  ///< in h: faces as near to a point that the mesh does not show go
  /// Fronts that have gone on inside out start once more. Not between walls so close that few
  /// directions see into the gap: the votes there are those of the rims.
  bool only_outwards = true;
  bool is_body = true;  ///< not a sheet: faces have an outside and an inside
  /// left_out_points() of the mesh by kLeftOut, if they are known. Must outlive the call.
  const std::vector<Vec3>* left_out = nullptr;
};

/// Grows a surface over places that no scan has reached: deep in slots and cavities, and where two
/// surfaces are as near to each other as 2 h, and whole bodies inside of others
/// (core/finish/grow_bodies.h), if it is of bodies whose points have votes: not of polygons, of
/// which what lies inside is not to be seen. Where points are left out
/// (core/finish/left_out_points.h, by more than 0.7 h, or three times the noise; 40 at least), what
/// hides the way to them goes first: within 3 h of them faces in the air, whose centroid, corners
/// or middles of sides have no point within 0.75 h or one spacing, faces within `in_the_way` of a
/// point that the mesh does not show (off it by 0.42 h, or twice the noise), faces whose own
/// points, within 0.75 h, are seen from behind them (VotesNear), and pieces of less than a
/// dozen faces that are left, or of less than forty with votes: one that a scan saw from behind,
/// through a wall of sparse points, would grow on inside out. With 0.9 h thin walls keep their
/// other side; 2 h also takes what bends into the mouth of a hole and on along the wall's back,
/// from where the wall would grow inside out. Then an advancing front
/// (core/finish/grow_over.h) goes over the points up to 4 h from those left out, and joins what it
/// meets; if over 10 h^2 of faces that hang together have come inside out, by the votes, as from a
/// scrap across the mouth of a bore down its wall, once more from the start, with no such face
/// within 4 h of those; the same, unless fewer points are reached that way, if no votes tell but of
/// a body so much faces inwards (core/finish/facing_inwards.h); where points are sparse, over 0.6 h
/// apart, and it has stopped all around a place without any, of 1 h in radius at most (1.15 h where
/// they are over 0.9 h apart), it is closed; and where it is stuck between such points it starts
/// again (core/finish/restart_fronts.h; up to 0.9 h). So the way there leads over the surface, not
/// through the air, and of holes only those without points are left.
///
/// Points with noise of over 0.08 h are first moved, three times, onto the plane through those
/// within 1.3 h, and only what the mesh leaves out even then counts: layers that scans out of place
/// make are none. With over 0.3 h nothing is done, since what is left out is noise, too.
/// @param seen the cloud; without votes no face is told by them
/// @param grid of the same points
/// @pre oriented, manifold; stays so. Faces that come cross none. Vertices keep their numbers, also
///     those that no face is left of.
GrowthReport regrow(TriangleMesh& mesh, const SeenPoints& seen, const PointGrid& grid,
                    const RegrowOptions& options, const Progress& progress = {});

}  // namespace rangezip
