#pragma once

#include "core/stitch/joint.h"
#include "core/stitch/stitch.h"

namespace rangezip {

/// The paper's zippering [Kobbelt, Botsch 2000, 4.4; Turk, Levoy 1994] up to the joined mesh: the
/// vertices of the patch's boundary are inserted into the old surface (insert_vertices.h), then
/// its edges (insert_segments.h), the old faces inside go (remove_covered.h), and the patch takes
/// their place, sharing its boundary with the old surface. What of the boundary could not be
/// inserted, where it leaves the old surface, is joined by a strip as in clear_and_fill().
/// Vertices where fans touch are not yet opened, short edges not yet collapsed: see stitch().
/// @param record receives what was inserted where
/// @throws TopologyError as stitch() does
[[nodiscard]] Joint zipper(TriangleMesh mesh, const PatchScan& scan, const StitchOptions& options,
                           StitchReport& report, StitchRecord& record);

}  // namespace rangezip
