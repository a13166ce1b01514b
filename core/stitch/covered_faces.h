#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/triangle_mesh.h"
#include "core/stitch/image_plane.h"
#include "core/stitch/patch_sheet.h"

namespace rangezip {

struct CoveredFacesOptions {
  double band = 1.0;       ///< half width of the depth band, pixel sides times stretch
  double clearance = 0.4;  ///< pixels
};

/// Marks (1) the faces that the patch replaces: those that look at the viewer (or are seen nearly
/// on edge), overlap a cell of the patch in the image, and lie within the band around it there;
/// and those that look at the viewer and have a corner within `clearance` of such a cell.
/// The overlap is judged per row of cells by the extent of the face in that row, rounded outward.
/// O(faces + area of the faces near the patch), parallel.
[[nodiscard]] std::vector<std::uint8_t> find_covered_faces(const TriangleMesh& mesh,
                                                           const ImagePlane& image,
                                                           const PatchSheet& sheet,
                                                           const CoveredFacesOptions& options);

}  // namespace rangezip
