#pragma once

#include "core/stitch/joint.h"
#include "core/stitch/stitch.h"

namespace rangezip {

/// Removes all old faces under and close to the patch and fills the strip between the two
/// boundaries by a constrained Delaunay triangulation in the image plane. Cannot fail half-way:
/// what does not fit stays open, one strip triangle at a time. Vertices where fans touch are not
/// yet opened: see stitch(), which does the rest.
/// @throws TopologyError as stitch() does
[[nodiscard]] Joint clear_and_fill(TriangleMesh mesh, const PatchScan& scan,
                                   const StitchOptions& options, StitchReport& report);

}  // namespace rangezip
