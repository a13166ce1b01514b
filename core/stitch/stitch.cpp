#include "core/stitch/stitch.h"

#include <string>
#include <utility>

#include "core/base/error.h"
#include "core/stitch/clean_up.h"
#include "core/stitch/clear_and_fill.h"

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

}  // namespace

StitchResult stitch(TriangleMesh mesh, const Scan& scan, const StitchOptions& options) {
  check_indices(mesh);
  if (scan.patch.mesh.empty()) return {std::move(mesh), {}};
  StitchReport report;
  Joint joint = clear_and_fill(std::move(mesh), scan, options, report);
  const CleanUpReport cleaned =
      clean_up(joint.mesh, std::move(joint.touched), options.min_component);
  report.opened_fans = cleaned.opened_fans;
  report.split_vertices = cleaned.split_vertices;
  report.dropped_components = cleaned.dropped_components;
  report.dropped_faces = cleaned.dropped_faces;
  return {std::move(joint.mesh), report};
}

}  // namespace rangezip
