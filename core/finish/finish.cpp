#include "core/finish/finish.h"

#include <cmath>
#include <string>

#include "core/base/error.h"
#include "core/finish/boundary_loops.h"
#include "core/finish/corner_table.h"
#include "core/finish/extend_border.h"
#include "core/finish/point_grid.h"
#include "core/finish/relax.h"
#include "core/finish/repair.h"
#include "core/finish/snap_features.h"

namespace rangezip {
namespace {

/// In h: about half the radius in which points around a vertex are looked for.
constexpr double kPointCell = 0.7;
/// In h: how far beyond the mesh points may matter.
constexpr double kRegionMargin = 4.0;

void check(const FinishOptions& options) {
  if (!(options.pixel_size > 0.0) || !std::isfinite(options.pixel_size)) {
    throw InvalidArgument("finish: pixel_size must be positive and finite, got " +
                          std::to_string(options.pixel_size));
  }
}

Box region_of(const TriangleMesh& mesh, double margin) {
  Box region = bounds_of(mesh);
  region.lower -= Vec3(margin);
  region.upper += Vec3(margin);
  return region;
}

}  // namespace

FinishResult finish(TriangleMesh mesh, std::span<const Vec3> cloud, const FinishOptions& options,
                    const Progress& progress) {
  check(options);
  FinishResult result;
  if (mesh.empty()) return result;
  progress.at("finish", 0.0);
  const double h = options.pixel_size;
  const PointGrid points(cloud, region_of(mesh, kRegionMargin * h), kPointCell * h);
  repair(mesh, points, options, result.report, progress);
  if (options.method == FinishMethod::full) {
    const RelaxReport relaxed = relax(mesh, points, {h, options.relaxations}, progress);
    result.report.collapsed_edges = relaxed.collapsed_edges;
    result.report.flipped_edges = relaxed.flipped_edges;
    result.report.flattened_spikes = relaxed.flattened_spikes;
    if (options.snap_features) {
      const SnapReport snapped = snap_features(mesh, points, {h}, progress);
      result.report.snapped_vertices = snapped.snapped_vertices;
      result.report.collapsed_edges += snapped.collapsed_edges;
      result.report.flipped_edges += snapped.flipped_edges;
    }
    repair(mesh, points, options, result.report, progress);
    const ExtendBorderReport extended = extend_border(
        mesh, points, {.pixel_size = h, .min_component = options.min_component}, progress);
    result.report.border_steps = extended.steps;
    result.report.dropped_components += extended.dropped.components;
    result.report.dropped_faces += extended.dropped.faces;
  }
  const CornerTable table(mesh.triangles, mesh.positions.size());
  result.report.open_loops = boundary_loops(table).size();
  result.mesh = std::move(mesh);
  progress.at("finish", 1.0);
  return result;
}

}  // namespace rangezip
