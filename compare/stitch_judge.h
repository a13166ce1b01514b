#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "compare/geodesic_judge.h"
#include "compare/location_judge.h"
#include "compare/mesh_judge.h"
#include "core/base/progress.h"
#include "core/raster/rasterizer.h"
#include "core/scan/scan.h"
#include "core/scene/scene.h"
#include "core/session/command.h"
#include "core/stitch/stitch_record.h"

namespace rangezip::compare {

struct StitchJudgeOptions {
  double slack = 0.1;                 ///< of a location, pixel sides
  std::size_t sample_above = 50'000;  ///< of a mesh with more faces not all segments are followed,
  std::size_t sample = 1'000;         ///< but so many, spread evenly over the boundary
  std::uint64_t seed = 1;             ///< of their choice
};

/// The boundary segments of a patch that became edges of the old surface, beside the shortest
/// paths over it.
struct SegmentVerdict {
  std::size_t inserted = 0;
  std::size_t followed = 0;    ///< chosen to be judged
  std::size_t lost = 0;        ///< of those: the line does not arrive, or CGAL gave no answer
  std::vector<double> ratios;  ///< of the others: length through their faces to the shortest
  std::vector<double>
      line_ratios;  ///< of the others: the straight line in the image to the shortest
  std::vector<double> deviations;  ///< of the others: from the shortest path, pixel sides
};

/// CGAL's verdict on one stitch.
struct StitchVerdict {
  double pixel_size = 0.0;     ///< the smallest of the patch's samples, model units
  double slack = 0.0;          ///< of locations, model units
  LocationVerdict samples;     ///< each vertex of the patch: the corresponding face
  LocationVerdict insertions;  ///< zipper: each inserted vertex: the face it was put into, in the
                               ///< line of sight
  LocationVerdict nearest;     ///< the same against the nearest face
  SegmentVerdict segments;     ///< zipper
};

/// Judges what the scan and the stitch decided: the faces by the AABB tree, the segments by the
/// shortest paths.
/// @param before the mesh that both saw
/// @throws InvalidArgument if the scan or the record does not belong to that mesh
[[nodiscard]] StitchVerdict judge_stitch(const TriangleMesh& before, const Scan& scan,
                                         const StitchRecord& record,
                                         const StitchJudgeOptions& options = {});

/// The mesh after a command, and the stitch, if it was one.
struct StitchStep {
  MeshVerdict mesh;
  std::optional<StitchVerdict> stitch;
  bool is_repeatable = true;      ///< a stitch made again gave the same mesh
  bool is_finished = false;       ///< the command was the finish, after which nothing may cross
  std::size_t new_crossings = 0;  ///< of a stitch: self-intersections that were not there before
};

/// Plays a session command by command and judges every stitch and every mesh.
/// @throws what Session::apply() throws; InvalidArgument then begins with "/commands/N: "
[[nodiscard]] std::vector<StitchStep> judge_stitches(
    const Scene& scene, const TriangleMesh& initial, std::span<const Command> commands,
    Rasterizer& rasterizer, const StitchJudgeOptions& options = {}, const Progress& progress = {});

}  // namespace rangezip::compare
