#pragma once

#include <cstdint>
#include <span>

#include "core/scan/scan.h"

namespace rangezip {

/// What a stitch reads of a scan. The patch may be less than the scan's own, and the mesh a part of
/// the one that the scan has seen. What is referred to must outlive this.
struct PatchScan {
  const RangeImage& image;
  const SlopeImage& slopes;
  const Grid<PrimitiveId>& seen_face;  ///< of the mesh that the scan has seen
  const Patch& patch;
  std::span<const std::uint32_t> face_in_seen;  ///< number there of each face of the mesh,
                                                ///< ascending; empty: the same

  /// All of a scan. Implicit: a whole scan can always stand for it.
  PatchScan(const Scan& scan) : PatchScan(scan, scan.patch, {}) {}

  PatchScan(const Scan& scan, const Patch& part, std::span<const std::uint32_t> face_numbers)
      : image(scan.image),
        slopes(scan.slopes),
        seen_face(scan.correspondence.face),
        patch(part),
        face_in_seen(face_numbers) {}
};

}  // namespace rangezip
