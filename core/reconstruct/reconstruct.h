#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/mesh/mesh_report.h"
#include "core/mesh/triangle_mesh.h"
#include "core/raster/rasterizer.h"
#include "core/reconstruct/coverage_report.h"
#include "core/scene/scene.h"
#include "core/session/command.h"
#include "core/session/session.h"

namespace rangezip {

enum class ReconstructMethod {
  automatic,  ///< plane-fit samples, depth-band correspondence, clear and fill
  paper,      ///< the paper as written: z-buffer minimum, median, largest gap, ID buffer, zippering
};

struct ReconstructOptions {
  ReconstructMethod method = ReconstructMethod::automatic;
  std::optional<double> pixel_size;      ///< model units; absent: from the point spacing
  std::optional<std::size_t> triangles;  ///< target count, met within a few percent: by the full
                                         ///< finish, else by repeating the run with other pixels
  std::optional<int> views;              ///< planned views; absent: until the cloud is covered
  std::optional<double> decimate;        ///< in pixel sides: triangles grow where they stay within
                                         ///< this of the surface, in the full finish, else in scans
  double close_holes = 0.0;              ///< in pixel sides: the finish closes holes up to this
                                         ///< perimeter even where no points show a surface
  std::optional<FinishMethod> finish = FinishMethod::full;  ///< absent: no finish
  std::vector<Vec3> scanners;  ///< where scanners stood: what shows them its back is turned; none:
                               ///< all faces the outside, or the first view
  int threads = 0;             ///< 0: all of the machine; the mesh never depends on it
};

struct StageTime {
  std::string stage;
  double seconds = 0.0;      ///< wall
  double cpu_seconds = 0.0;  ///< of the whole process
};

struct ReconstructReport {
  double pixel_size = 0.0;
  std::vector<Vec3> views;  ///< toward the viewer, planned ones first
  std::size_t planned_views = 0;
  double planned_coverage = 0.0;           ///< share of the points that the planned views see
  std::vector<std::size_t> view_commands;  ///< per view: where among the commands its scan is
  std::optional<std::size_t> finish_command;
  std::vector<CommandReport> commands;
  std::vector<StageTime> stages;  ///< of a repeated run one after the other
  CoverageReport coverage;
  MeshReport mesh;
  std::size_t turned_components = 0;   ///< toward the scanners
  std::size_t self_intersections = 0;  ///< pairs
};

struct ReconstructResult {
  TriangleMesh mesh;
  ReconstructReport report;
  std::vector<Command> commands;  ///< what was done: a session that gives the same mesh
};

/// From raw data to a clean mesh in one call: chooses the resolution, plans views, scans and
/// stitches each, fills what is left by views of what is uncovered and into the holes, finishes,
/// and checks.
/// @throws InvalidArgument if the scene is empty, has fewer than three distinct points, or all on a
///     line; or if an option is out of range.
[[nodiscard]] ReconstructResult reconstruct(const Scene& scene, Rasterizer& rasterizer,
                                            const ReconstructOptions& options = {},
                                            const Progress& progress = {});

}  // namespace rangezip
