#pragma once

#include <cstddef>
#include <vector>

#include "core/base/geometry.h"
#include "core/finish/corner_table.h"

namespace rangezip {

// Each visits every inner edge once, in the order of the corners, and turns it where that is
// better. None turns an edge that would fold a face over, make an edge much sharper, or is not
// CornerTable::is_flip_ok(). Each returns the number of edges turned.

/// Turns edges whose smallest angle of the two faces grows.
std::size_t flip_for_angles(CornerTable& table, const std::vector<Vec3>& positions);

/// Turns edges so that inner vertices get nearer to six neighbours, as long as no angle falls under
/// 20 degrees that was not so small before; also those that mend such an angle.
std::size_t flip_for_valence(CornerTable& table, const std::vector<Vec3>& positions);

/// Turns edges so that the two faces follow the surface's normals, as long as no angle falls under
/// 30 degrees: triangles then lie along the lines of least bending [Dyn, Levin, Rippa 1990].
/// @param normals the surface's, one a vertex; edges with a zero normal at a corner stay
std::size_t flip_for_normals(CornerTable& table, const std::vector<Vec3>& positions,
                             const std::vector<Vec3>& normals);

}  // namespace rangezip
