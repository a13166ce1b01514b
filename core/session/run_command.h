#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/progress.h"
#include "core/mesh/triangle_mesh.h"
#include "core/plan/visibility_vote.h"
#include "core/raster/rasterizer.h"
#include "core/scene/scene.h"
#include "core/session/command.h"

namespace rangezip {

/// What a command did; the members that do not apply stay zero.
struct CommandReport {
  ScanReport scan;
  StitchReport stitch;
  FinishReport finish;
  std::size_t erased_faces = 0;
  std::size_t filled_holes = 0;
  std::size_t turned_components = 0;  ///< toward scanners
  std::size_t handles = 0;            ///< of the whole mesh after the command (core/mesh/handles.h)
  double seconds = 0.0;               ///< wall time
};

/// The votes of one scene, computed once for each distinct set of options and then kept
/// (3 bytes a point).
class VoteCache {
 public:
  /// The reference stays valid until the next call.
  [[nodiscard]] const VisibilityVotes& votes(Rasterizer& rasterizer, const Scene& scene,
                                             const VoteOptions& options,
                                             const Progress& progress = {});

 private:
  std::vector<std::pair<VoteOptions, VisibilityVotes>> entries_;
};

struct CommandResult {
  TriangleMesh mesh;
  CommandReport report;
  std::optional<Scan> scan;  ///< AddScan: every intermediate product
};

/// Carries out one command: the one place that says what each means, shared by reconstruct(), which
/// records what it does, and Session, which plays it back, so both give the same bits.
/// `mesh` is taken by value: a caller who moves it pays no copy, one who copies has it for undo.
/// @param votes of this scene; filled on demand
/// @throws InvalidArgument if an option is out of range, or for UndoSteps, which only a Session can
///     carry out; and what scan(), stitch(), erase_region(), laplacian_smooth(), fill_mesh_holes()
///     and finish() throw.
[[nodiscard]] CommandResult run_command(const Command& command, const Scene& scene,
                                        TriangleMesh mesh, VoteCache& votes, Rasterizer& rasterizer,
                                        const Progress& progress = {});

/// What FinishMesh fits vertices to: all points of the scene, then area samples of its triangles
/// (none if it has no triangles), world coordinates: 8 for the square of a pixel, so that what is
/// fitted to those around a place does not end with them; 20,000 at least, 4,000,000 at most.
/// @param pixel_size model units; 0: not known, 200,000 samples
[[nodiscard]] std::vector<Vec3> evidence_points(const Scene& scene, double pixel_size = 0.0);

/// Mean length over the three edges of every triangle, model units: what stands in for the pixel
/// size of a mesh whose scans are not known. Edges inside the mesh count twice. O(faces).
/// @throws InvalidArgument if the mesh has no triangle.
[[nodiscard]] double mean_edge_length(const TriangleMesh& mesh);

}  // namespace rangezip
