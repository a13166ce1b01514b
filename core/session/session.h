#pragma once

#include <cstddef>
#include <memory>
#include <span>
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
  double seconds = 0.0;  ///< wall time
};

struct SessionOptions {
  std::size_t history_bytes = std::size_t{256} << 20U;  ///< older meshes beyond this are dropped and
                                                        ///< replayed when undo needs them
};

/// The one object with a history. Holds the input, the commands so far and the meshes after them;
/// every mesh is immutable and shared, so undo is a step back in a list and a viewer may keep
/// drawing one mesh while the next is being made.
class Session {
 public:
  explicit Session(Scene scene, const SessionOptions& options = {});
  /// Starts from a mesh, such as a CAD model into which a physical scan is stitched.
  Session(Scene scene, TriangleMesh initial, const SessionOptions& options = {});

  [[nodiscard]] const Scene& scene() const noexcept { return scene_; }
  [[nodiscard]] std::shared_ptr<const TriangleMesh> mesh() const noexcept;  ///< never null
  /// The commands whose result mesh() is; UndoSteps itself is never in it.
  [[nodiscard]] std::span<const Command> history() const noexcept;

  /// Carries out `command` on top of the current mesh and drops what could be redone. Throws what
  /// the command's function throws; the session is then unchanged.
  CommandReport apply(const Command& command, Rasterizer& rasterizer,
                      const Progress& progress = {});

  /// @return false if there is nothing to take back / to bring back.
  bool undo(Rasterizer& rasterizer);
  bool redo(Rasterizer& rasterizer);

 private:
  struct Impl;
  Scene scene_;
  std::shared_ptr<Impl> impl_;
};

}  // namespace rangezip
