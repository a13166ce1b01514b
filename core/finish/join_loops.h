#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/progress.h"
#include "core/finish/mesh_pieces.h"
#include "core/finish/point_grid.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

struct JoinedLoops {
  std::size_t pairs = 0;                  ///< that were joined, at least in part
  std::vector<std::uint8_t> is_hindered;  ///< of vertices: in a loop that is not to be filled,
                                          ///< since its strip only crosses something
};

/// Closes the gaps in walls of holes that lead through the object (own). Scans from both ends of
/// such a hole each show a part of its wall, and two boundary loops are left with a gap between
/// them. If each loop is closed on its own, the hole is papered over twice; a strip from one to the
/// other closes the gap and makes a handle. For every two loops that run beside each other within 3
/// h, the least sharp strip between them is made, with no edge over 4 h, and taken for the surface
/// of the object rather than the two fills if
/// - where at least half of the inner edges of the strip are longer than 1.2 h, so that points can
///   tell: the cloud has none inside of either fill, away from its loop, unless the other fill
///   would lie in the air, and neither loop is a nick of under 6 h in a smooth sheet; 65 % of the
///   middles of these edges do not lie on the mesh as it is, and 70 % have a point within 0.6 h (50
///   % and 30 % if one of the fills would lie in the air). The strip goes on from the faces beside
///   it with a mean cosine of 0.3, and better than the fills unless one of these would lie in the
///   air. Where it is over 2.4 h wide these points belong to no sheet beside it: then 0.9 h and
///   -0.25 are enough;
/// - where no point can tell, the strip goes on from the faces beside it with a mean cosine of 0.5,
///   and better than the fills.
/// Loops of two components are joined only if a fill would lie in the air, and 70 % have a point.
/// A loop is joined once; the narrowest strips come first. Of a strip that crosses the mesh or
/// another one, the next of its loops is tried; then what of it crosses nothing is made, if that is
/// 80 % of its faces and the strip is sure: a fill would lie in the air; or 80 % of its middles do
/// not lie on the mesh, and not both fills go on from the faces beside them with a mean cosine of
/// 0.8, as in a sheet. Else, where a fill would lie in the air, its loops are named: they may be
/// joined once faces around them are gone, and should not be filled before. Not where holes are too
/// small to tell: the faces around them may be all there is of a thin limb. O(faces), and for each
/// pair of loops what a dozen of their fills cost. The mesh stays oriented, manifold and without
/// self-intersections. In parallel.
/// @param pieces of the mesh, as it is before
/// @param cloud may be empty: then faces alone tell
/// @param pixel_size h, model units; positive
/// @param has_narrow_gaps the cloud shows gaps that scans reach only in part: where it is sparse a
///     point counts within a spacing, not within 1.3, which may be half of such a gap
/// @throws Cancelled if `progress` says so.
/// @pre oriented, manifold, no self-intersections
JoinedLoops join_loops(TriangleMesh& mesh, const MeshPieces& pieces, const PointGrid& cloud,
                       double pixel_size, bool has_narrow_gaps = false,
                       const Progress& progress = {});

}  // namespace rangezip
