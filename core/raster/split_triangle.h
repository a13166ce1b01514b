#pragma once

#include <array>
#include <vector>

#include "core/base/geometry.h"
#include "core/raster/row_transform.h"

namespace rangezip {

/// Corners of a triangle on the window's integer grid.
using SnappedTriangle = std::array<SnappedPosition, 3>;

/// R8 and R11: cuts away what lies behind the eye, outside of the guard range or outside of a clip
/// plane, and appends what is left as triangles, to be drawn with the ID of the whole. For
/// triangles with a corner that snap_positions() or reject_clipped() rejects; every backend calls
/// this one function, so all draw the same pieces.
///
/// A corner that both of them keep is kept where they put it, and an edge is cut at the same place
/// from whichever triangle it is seen, so that neighbours still meet without a gap.
/// @return false, and no piece, if a corner is not finite
[[nodiscard]] bool split_triangle(const RowTransform& rows, const std::array<Vec3f, 3>& corners,
                                  std::vector<SnappedTriangle>& pieces);

}  // namespace rangezip
