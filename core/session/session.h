#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "core/base/progress.h"
#include "core/mesh/triangle_mesh.h"
#include "core/raster/rasterizer.h"
#include "core/scene/scene.h"
#include "core/session/command.h"
#include "core/session/run_command.h"

namespace rangezip {

struct SessionOptions {
  std::size_t history_bytes = std::size_t{256} << 20U;  ///< meshes of the history beyond this are
                                                        ///< dropped, those farthest from the
                                                        ///< current one first, and replayed when
                                                        ///< undo or redo needs them
};

/// The one object with a history. Holds the input, the commands so far and the meshes after them;
/// every mesh is immutable and shared, so undo is a step back in a list and a viewer may keep
/// drawing one mesh while the next is being made. The first and the current mesh are always kept.
///
/// Every function that throws leaves the session as it was.
class Session {
 public:
  explicit Session(Scene scene, const SessionOptions& options = {});
  /// Starts from a mesh, such as a CAD model into which a physical scan is stitched.
  Session(Scene scene, TriangleMesh initial, const SessionOptions& options = {});
  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;
  ~Session();

  [[nodiscard]] const Scene& scene() const noexcept;
  [[nodiscard]] std::shared_ptr<const TriangleMesh> mesh() const noexcept;  ///< never null
  /// The commands whose result mesh() is; UndoSteps itself is never in it.
  [[nodiscard]] std::span<const Command> history() const noexcept;

  /// Carries out `command` on top of the current mesh and drops what could be redone. UndoSteps
  /// takes back that many commands instead, and redo() can bring them back.
  /// @throws InvalidArgument if UndoSteps asks for fewer than one step or more than there are; and
  ///     what run_command() throws.
  CommandReport apply(const Command& command, Rasterizer& rasterizer,
                      const Progress& progress = {});

  /// The votes of the scene, computed once for each value of the options. The reference stays valid
  /// until the next call, or that of apply(), undo() or redo().
  [[nodiscard]] const VisibilityVotes& votes(Rasterizer& rasterizer, const VoteOptions& options,
                                             const Progress& progress = {});

  /// The scan of the last AddScan applied, for its images; null if the last command was another.
  [[nodiscard]] std::shared_ptr<const Scan> last_scan() const noexcept;

  /// One step back or forward. Cheap while the mesh is kept; else replays from the nearest kept one
  /// before it, and throws what run_command() throws.
  /// @return false if there is nothing to take back / to bring back.
  bool undo(Rasterizer& rasterizer, const Progress& progress = {});
  bool redo(Rasterizer& rasterizer, const Progress& progress = {});

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace rangezip
