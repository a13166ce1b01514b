#pragma once

#include <cstddef>

#include "core/stitch/patch_sheet.h"
#include "core/stitch/sheet_mesh.h"

namespace rangezip {

/// Third step of zippering: deletes the faces that look at the viewer and whose centroid the patch
/// covers within the depth band; also those around a skipped segment of which only a corner or a
/// side is covered. Each face is judged by itself, so no gap in the boundary can let the removal
/// spread, as a flood fill would.
/// @param band half width, pixel sides times stretch
/// @return how many were deleted
[[nodiscard]] std::size_t remove_covered_faces(SheetMesh& sheet, const PatchSheet& patch,
                                               double band);

}  // namespace rangezip
