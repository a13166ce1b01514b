#include "core/finish/sharpen.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/finish/clean_topology.h"
#include "core/finish/face_part.h"
#include "core/finish/reach_points.h"
#include "core/finish/separate.h"
#include "core/mesh/face_changes.h"
#include "core/mesh/self_intersection.h"

namespace rangezip {
namespace {

constexpr int kReachRounds = 3;   ///< of {bring rims out, snap again around}
constexpr int kRoundsAround = 4;  ///< of snapping again, without what crosses
/// Edges around what has changed: so far vertices are snapped again, and so far features and clean
/// surfaces are looked for.
constexpr int kRingsToMove = 3;
constexpr int kRingsToLook = 8;

/// What it did to triangles.
void add_changes(const SnapReport& snapped, FinishReport& report) {
  report.split_edges += snapped.split_edges;
  report.collapsed_edges += snapped.collapsed_edges;
  report.flipped_edges += snapped.flipped_edges;
}

/// Whether a mesh is oriented and manifold: what was done to a part must fit the rest.
bool is_sound(const TriangleMesh& mesh) {
  TriangleMesh cleaned = mesh;
  clean_topology(cleaned);
  return cleaned.triangles == mesh.triangles;
}

/// Snaps again around faces that came.
void snap_around(TriangleMesh& mesh, std::span<const std::uint32_t> came, const PointGrid& cloud,
                 SnapOptions snapping, FinishReport& report, const Progress& progress) {
  const FacePart part = part_within(mesh, came, kRingsToLook);
  std::vector<std::uint8_t> may_move = vertices_within(mesh, came, kRingsToMove);
  for (int round = 1; round <= kRoundsAround; ++round) {
    snapping.is_kept.clear();
    for (const std::uint32_t v : part.vertices)
      snapping.is_kept.push_back(may_move[v] != 0 ? 0 : 1);
    FacePart part_after = part;
    const SnapReport snapped = snap_features(part_after.mesh, cloud, snapping, progress);
    if (snapped.snapped_vertices == 0) return;
    TriangleMesh after = mesh;
    put_back(std::move(part_after), after);
    if (!is_sound(after)) return;
    const std::vector<std::uint32_t> changed = find_face_changes(mesh, after).made;
    const auto crossing = self_intersections(after, changed, {}, progress);
    if (crossing.empty()) {
      mesh = std::move(after);
      add_changes(snapped, report);
      return;
    }
    const auto crosses = vertices_within(after, faces_of_pairs(crossing), round);
    for (std::size_t v = 0; v < may_move.size(); ++v) {
      if (crosses[v] != 0) may_move[v] = 0;
    }
  }
}

void snap(TriangleMesh& mesh, const PointGrid& cloud, const SnapOptions& snapping,
          const FinishOptions& options, FinishReport& report, const Progress& progress) {
  const TriangleMesh clean = geometry_of(mesh);
  const SnapReport snapped = snap_features(mesh, cloud, snapping, progress);
  report.snapped_vertices = snapped.snapped_vertices;
  add_changes(snapped, report);
  if (snapped.snapped_vertices == 0) return;
  const TriangleMesh sharp = geometry_of(mesh);
  const std::vector<std::uint32_t> changed = find_face_changes(clean, mesh).made;
  if (!separate(mesh, changed, cloud, options, report, progress)) return;
  snap_around(mesh, find_new_faces(sharp, mesh), cloud, snapping, report, progress);
}

}  // namespace

void sharpen(TriangleMesh& mesh, const PointGrid& cloud, const SnapOptions& snapping,
             const FinishOptions& options, FinishReport& report, const Progress& progress) {
  snap(mesh, cloud, snapping, options, report, progress);
  for (int round = 0; round < kReachRounds; ++round) {
    const TriangleMesh before = mesh;
    const std::size_t moves = reach_points(
        mesh, cloud,
        {.pixel_size = snapping.pixel_size, .edge = snapping.edge, .noise = snapping.fit.noise},
        progress);
    if (moves == 0) return;
    if (!is_sound(mesh)) {
      mesh = before;
      return;
    }
    report.rim_moves += moves;
    separate(mesh, find_face_changes(before, mesh).made, cloud, options, report, progress);
    if (round + 1 == kReachRounds) return;
    snap_around(mesh, find_new_faces(before, mesh), cloud, snapping, report, progress);
  }
}

}  // namespace rangezip
