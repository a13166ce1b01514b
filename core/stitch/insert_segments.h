#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/stitch/sheet_mesh.h"

namespace rangezip {

struct InsertedSegments {
  std::vector<std::uint8_t> is_edge;  ///< one per segment: 1 if it is an edge of the sheet now
  std::size_t inserted = 0;           ///< of those, found or made
  std::size_t skipped = 0;            ///< that leave the sheet
  std::size_t flips = 0;
};

/// Second step of zippering: every segment between two vertices of the sheet becomes an edge of it,
/// by flipping the edges that its straight line in the image crosses [Sloan 1993]. The straight
/// line stands for the geodesic of the paper [Kobbelt, Botsch 2000, 4.4]. A segment whose line
/// leaves the faces that look at the viewer is skipped. An old vertex exactly on the line has its
/// image moved by one grid step, to the left of the segment: the side of the patch.
/// @param segments directed, the patch on their left; they touch in common ends only
[[nodiscard]] InsertedSegments insert_boundary_segments(
    SheetMesh& sheet, std::span<const std::array<SheetMesh::VertexHandle, 2>> segments);

}  // namespace rangezip
