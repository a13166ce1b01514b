#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/mesh/triangle_mesh.h"
#include "core/raster/rasterizer.h"
#include "core/scan/scan.h"
#include "core/scene/scene.h"
#include "core/session/command.h"

namespace rangezip::compare {

/// One stage of a command, compared bit for bit.
struct StageVerdict {
  std::string name;           ///< "framebuffers", "range image", ...
  std::size_t compared = 0;   ///< drawings, pixels, or vertices and faces
  std::size_t different = 0;  ///< of those
  std::string first;          ///< where the first of them is: "pixel (3, 4)", "face 12"

  [[nodiscard]] bool identical() const noexcept { return different == 0; }
};

/// The products of one scan in the order in which the data flows: "scene framebuffer", "range
/// image", "filled", "slopes", "correspondence", "mask", "patch".
[[nodiscard]] std::vector<StageVerdict> judge_scans(const Scan& reference, const Scan& candidate);

/// The stage "mesh": positions, faces and sources; what one side lacks differs.
[[nodiscard]] StageVerdict judge_meshes(const TriangleMesh& reference,
                                        const TriangleMesh& candidate);

/// The stages of one command: "framebuffers" (all drawings, also the sums), then for a scan those
/// of judge_scans(), then "mesh".
struct CommandVerdict {
  std::vector<StageVerdict> stages;

  [[nodiscard]] bool identical() const noexcept;
  /// @pre !identical()
  [[nodiscard]] const StageVerdict& first_difference() const;
};

/// Plays a session once with each rasterizer, command by command, and compares every product on the
/// way. Ends after the first command with a difference, since what follows differs by it: all
/// verdicts but the last are then identical, and its first stage that differs is where the
/// difference begins. Each drawing of the candidate is compared with the reference's of the same
/// arguments (CheckedRasterizer), which is drawn twice for that.
/// @throws what Session::apply() throws; InvalidArgument then begins with "/commands/N: "
[[nodiscard]] std::vector<CommandVerdict> judge_session(
    const Scene& scene, const TriangleMesh& initial, std::span<const Command> commands,
    Rasterizer& reference, Rasterizer& candidate, const Progress& progress = {});

}  // namespace rangezip::compare
