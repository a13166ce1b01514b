#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/progress.h"
#include "core/finish/finish.h"
#include "core/finish/point_grid.h"
#include "core/finish/settled_loops.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// Rounds of {cut the faces that cross others, bridge cracks between pieces, close holes}. A fill
/// or bridge that crosses anything is taken back and the hole widened by a ring of faces for the
/// next round. What is open after the last one is closed ear by ear (core/finish/ear_fill.h), if
/// that closes all of it; else it stays open. Of an open sheet comes back what went if that leaves
/// out points (core/finish/take_back_losses.h). The result is always oriented, manifold and
/// free of self-intersections. Adds to the counts of `report`.
/// @param crossing the pairs of faces that cross, self_intersections(mesh)
/// @param settled border that stays: its loops are not bridged, joined or closed
/// @param cloud evidence for holes (core/finish/hole_choice.h); may be empty
/// @throws Cancelled if `progress` says so.
void repair(TriangleMesh& mesh,
            const std::vector<std::pair<std::uint32_t, std::uint32_t>>& crossing,
            const SettledLoops& settled, const PointGrid& cloud, const FinishOptions& options,
            FinishReport& report, const Progress& progress);

/// Joins what was turned (core/finish/orient_pieces.h) to what it continues, and repairs the cracks
/// between, as repair() does; other loops stay as they are. Before anything grows: from both sides
/// of a crack, it would grow over the other side.
/// @throws Cancelled if `progress` says so.
/// @pre oriented and manifold; stays so
void close_joints(TriangleMesh& mesh, const PointGrid& cloud, const FinishOptions& options,
                  FinishReport& report, const Progress& progress);

/// Zips the loops that a repair has left open, and closes what that parts from them: what was cut
/// away around a loop, or is left of a fill, may be cracks that lead into a hole. No face goes but
/// those of small components: what would cross something stays open.
/// @throws Cancelled if `progress` says so.
/// @pre as repair() leaves a mesh
void zip_open_loops(TriangleMesh& mesh, const PointGrid& cloud, const FinishOptions& options,
                    FinishReport& report, const Progress& progress = {});

}  // namespace rangezip
