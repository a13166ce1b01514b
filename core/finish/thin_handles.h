#pragma once

#include <cstddef>

#include "core/finish/cloud_evidence.h"
#include "core/finish/point_grid.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

struct ThinHandleOptions {
  double max_girth = 0.0;            ///< model units; longer paths stay
  double filled_girth = 0.0;         ///< model units; up to this those around points do not
  const PointGrid* cloud = nullptr;  ///< tells filled ones; none: there are none
  CloudEvidence gaps;                ///< if the cloud shows narrow ones
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
/// @return how many paths were cut; call it again after closing the holes until none is
/// @pre oriented and manifold
std::size_t cut_thin_handles(TriangleMesh& mesh, const ThinHandleOptions& options);

}  // namespace rangezip
