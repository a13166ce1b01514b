#include "core/stitch/clear_and_fill.h"

#include "core/stitch/covered_faces.h"
#include "core/stitch/joint.h"
#include "core/stitch/patch_sheet.h"

namespace rangezip {

Joint clear_and_fill(TriangleMesh mesh, const PatchScan& scan, const StitchOptions& options,
                     StitchReport& report) {
  Joint joint = begin_joint(std::move(mesh), scan, options.view);
  const PatchSheet sheet(scan, sheet_radius(options));
  const std::vector<std::uint8_t> covered = find_covered_faces(
      joint.mesh, joint.image, sheet, {.band = options.band, .clearance = options.clearance});
  remove_old_faces(joint, covered, report);
  add_patch_faces(joint, scan.patch, report);
  fill_seam(joint, scan, sheet, options, report);
  return joint;
}

}  // namespace rangezip
