#pragma once

#include <vector>

#include "core/finish/boundary_loops.h"
#include "core/finish/corner_table.h"
#include "core/finish/face_tree.h"
#include "core/finish/point_grid.h"
#include "core/finish/triangulation_memo.h"

namespace rangezip {

/// Whether what closes a loop is a wall that the mesh lacks, as of a blade or a tail that is thin:
/// at a fifth of the places of a smooth fill over 0.35 h from the loop there are points of the
/// cloud, within 0.5 h, that the mesh does not show, being farther from it than 0.25 h and three
/// times the noise, and so is a fifth of all points there. A fill that folds back over an open
/// sheet has only the points of that sheet. A slit too narrow for such places is no sheet. O(faces)
/// for the faces around the loop, and what FaceTree::faces_in() takes to find them.
/// @param faces of the positions and the table
/// @param noise of the cloud, standard deviation, model units
/// @param pixel_size h, model units
/// @param memo as for fill_loop()
[[nodiscard]] bool is_other_wall(const std::vector<Vec3>& positions, const CornerTable& table,
                                 const BoundaryLoop& loop, const FaceTree& faces,
                                 const PointGrid& cloud, double noise, double pixel_size,
                                 TriangulationMemo* memo = nullptr);

}  // namespace rangezip
