#pragma once

#include <cstddef>

#include "core/base/progress.h"
#include "core/finish/cloud_evidence.h"
#include "core/finish/point_grid.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

struct ThinHandleOptions {
  double max_girth = 0.0;     ///< model units; longer paths stay
  double filled_girth = 0.0;  ///< model units; up to this those around points do not
  CloudEvidence cloud;        ///< tells these, and holes of the object; none: there are none
  CloudEvidence gaps;         ///< if the cloud shows narrow ones
};

/// Cuts handles and tunnels that are narrower than what scans resolve: such a handle is made by a
/// seam that joined two sheets where they come close, not by the object. Every edge gets a word,
/// such that the words along a closed path cancel if it parts the surface [Busaryev et al. 2012];
/// shortest paths around the few edges whose word is not 0 then find every path that is short and
/// parts nothing. The faces around such a path go, which leaves holes to close; of paths that
/// touch, or that would part the surface together, the shortest is cut. Boundary loops count as if
/// filled: they make no handle. O(faces) and the surroundings of those edges, a few rows of faces
/// for each handle.
/// With a cloud that shows narrow gaps, an edge whose middle has no point within 0.6 h (or 1.3
/// spacings) counts a tenth: what lies across a gap is cut there, however long the path around it;
/// an edge of a boundary counts a third, since the hole is filled, and the way across it shorter.
/// Longer paths, up to `filled_girth`, are cut where points lie inside of them, at least a quarter
/// as densely as along them: around a limb, or a hole that leads through, there is nothing within.
/// So are those beside which a ring of faces, the first, second or third one, lies in the air but
/// for a quarter (kCloseSupport), as in a tunnel through a wall that a gap in the points has made.
/// Any other path of over 3.5 h stays if it leads around a hole that points show: where 55 % of the
/// faces along it look at its axis (with a cosine of 0.3) and have a point within 0.6 h, or one
/// spacing. A hole of 2 h is 8 h around, but coarse faces that cut its corners are less.
/// @return how many paths were cut; call it again after closing the holes until none is
/// @throws Cancelled if `progress` says so.
/// @pre oriented and manifold
std::size_t cut_thin_handles(TriangleMesh& mesh, const ThinHandleOptions& options,
                             const Progress& progress = {});

}  // namespace rangezip
