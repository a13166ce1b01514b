#pragma once

#include <cstddef>

#include "core/finish/mesh_pieces.h"
#include "core/finish/point_grid.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// Joins pieces of a mesh over the cracks between them: where the boundary loops of two different
/// components run beside each other within three pixels for half of the shorter one, two triangles
/// go across at the narrowest place, so that the two loops become one crack that can be filled.
/// Loops of one component are joined, which makes a handle, only if they are the two sides of a
/// sharp edge all around a hole: long loops (40 vertices) beside each other all around, and at 80 %
/// of their places faces that turn by 60 degrees or more, each behind the other. Nor does a bridge
/// lead through the air: half way across it the cloud has points within 0.75 h, or one spacing, and
/// where it has narrow gaps not only on one side: the mean of those within h is no farther than
/// 0.65 h; and at half of the places where the loops lie over 1.6 h apart. So two surfaces that
/// face each other stay apart; nor does it turn back on a face beside it, unless the loops are
/// long (40 vertices) and beside each other all around, and the sheet that it leads to lies behind
/// that face: the rim of a blade, where one side reaches farther out than the other. Positions
/// stay.
/// @param pieces of the mesh, as it is before
/// @param cloud points of the cloud; may be empty: no evidence is asked for
/// @param pixel_size h, model units; positive
/// @param has_narrow_gaps the cloud shows gaps that scans reach only in part
/// @pre oriented, manifold
/// @return number of bridges; their faces are the last ones of the mesh, two each
std::size_t bridge_loops(TriangleMesh& mesh, const MeshPieces& pieces, const PointGrid& cloud,
                         double pixel_size, bool has_narrow_gaps = false);

/// The same, of two sheets that one crack parts, which opens into their borders: where loops run
/// beside each other for a part of their length (parts_side_by_side), a bridge at both ends of it
/// makes the crack a loop of its own. Between thin walls that are close to each other it would
/// close the gap: to be used where it is known that one piece continues the other.
std::size_t bridge_runs(TriangleMesh& mesh, const MeshPieces& pieces, const PointGrid& cloud,
                        double pixel_size, bool has_narrow_gaps = false);

}  // namespace rangezip
