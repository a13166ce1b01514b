#include "core/stitch/stitch.h"

#include <algorithm>
#include <string>
#include <utility>

#include "core/base/error.h"
#include "core/stitch/clean_up.h"
#include "core/stitch/clear_and_fill.h"
#include "core/stitch/collapse_seam.h"
#include "core/stitch/zipper.h"

namespace rangezip {

namespace {

void check_indices(const TriangleMesh& mesh) {
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const Triangle& t = mesh.triangles[f];
    const auto count = mesh.positions.size();
    const bool is_in_range = t[0] < count && t[1] < count && t[2] < count;
    if (!is_in_range || t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
      throw TopologyError("stitch: face " + std::to_string(f) +
                          " of the mesh must have three different existing corners");
    }
  }
}

/// Of the samples of the patch, model units.
double smallest_pixel_side(const Scan& scan) {
  double side = kNoSample;
  for (const Pixel p : scan.patch.pixels)
    side = std::min(side, scan.image.pixel_size(p));
  return side;
}

}  // namespace

StitchResult stitch(TriangleMesh mesh, const Scan& scan, const StitchOptions& options) {
  check_indices(mesh);
  if (scan.patch.mesh.empty()) return {.mesh = std::move(mesh)};
  StitchReport report;
  StitchRecord record;
  const bool is_zipper = options.method == StitchMethod::zipper;
  Joint joint = is_zipper ? zipper(std::move(mesh), scan, options, report, record)
                          : clear_and_fill(std::move(mesh), scan, options, report);
  const CleanUpReport cleaned =
      clean_up(joint.mesh, std::move(joint.touched), joint.seam, options.min_component);
  report.opened_fans = cleaned.opened_fans;
  report.split_vertices = cleaned.split_vertices;
  report.dropped_components = cleaned.dropped_components;
  report.dropped_faces = cleaned.dropped_faces;
  if (is_zipper && options.collapse_ratio > 0.0) {
    report.collapsed_edges = collapse_short_seam_edges(
        joint.mesh, joint.seam, options.collapse_ratio * smallest_pixel_side(scan));
  }
  return {std::move(joint.mesh), report, std::move(record)};
}

}  // namespace rangezip
