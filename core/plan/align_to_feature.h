#pragma once

#include <optional>

#include "core/plan/feature_line.h"
#include "core/view/camera.h"

namespace rangezip {

struct AlignedCamera {
  Camera camera;
  Extent extent;
  FeatureLine line;  ///< in the image that was given
};

/// Aligns the pixel grid with the dominant feature line of a scan, so that triangles end at the
/// feature and do not cut across it [Kobbelt, Botsch 2000, 4.1, Fig. 1]. The camera turns about its
/// viewing axis until the line of find_feature_line() runs along a row or a column, whichever is
/// nearer, and moves by less than a pixel until pixel centres lie on the line: a shift under a
/// parallel projection, a tilt about the eye under a central one, where a shift would depend on the
/// depth.
///
/// The pixel size stays. Under a parallel projection the image becomes as large as the samples need
/// after the turn, with a margin of four pixels; under a central one it keeps its extent.
/// @return nothing if there is no line
[[nodiscard]] std::optional<AlignedCamera> align_to_feature(const RangeImage& image);

}  // namespace rangezip
