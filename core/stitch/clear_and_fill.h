#pragma once

#include "core/stitch/stitch.h"

namespace rangezip {

/// The stitch that removes all old faces under and close to the patch and fills the strip between
/// the two boundaries, by a constrained Delaunay triangulation in the image plane. Cannot fail
/// half-way: what does not fit stays open, one strip triangle at a time. See stitch().
/// @throws TopologyError as stitch() does
[[nodiscard]] StitchResult clear_and_fill(TriangleMesh mesh, const Scan& scan,
                                          const StitchOptions& options);

}  // namespace rangezip
