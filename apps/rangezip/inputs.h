#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/rangezip/console.h"
#include "core/io/input_file.h"
#include "core/io/session_file.h"

namespace rangezip::app {

/// Reads all files as one scene, with progress. @throws IoError as read_scene().
[[nodiscard]] SceneInput read_inputs(const std::vector<std::filesystem::path>& paths,
                                     Console& console);

/// For a run that is to be replayed, from the session file if there is to be one.
/// @throws UsageError if one of the `paths` is a pipe or device, whose content cannot be read
/// again;
///     OutputError if the session cannot name it.
void require_rereadable(const std::vector<std::filesystem::path>& paths,
                        const std::optional<std::filesystem::path>& session);

/// "362,272 points, 69,451 triangles", without what there is none of.
[[nodiscard]] std::string amount_text(const Scene& scene);

/// "points not finite: 3, points repeated in one place: 99,999", what was left out of the files;
/// empty if nothing was.
[[nodiscard]] std::string skipped_text(std::span<const InputReport> reports);

/// The points to draw, or the triangles where there are none: what the rate of the work counts.
struct Workload {
  double amount = 0.0;
  std::string unit;
};
[[nodiscard]] Workload workload_of(const Scene& scene);

/// All files that were read: a .conf names others.
[[nodiscard]] std::vector<std::filesystem::path> files_of(const SceneInput& input);

/// A session of `commands` on what was read, with the hash of every file. To be recorded before
/// anything is written: the hashes are of what lies there now.
/// @throws IoError if a file has vanished; Cancelled if `progress` says so.
[[nodiscard]] SessionFile record_session(const std::vector<std::filesystem::path>& paths,
                                         const SceneInput& input,
                                         const std::optional<std::filesystem::path>& initial_mesh,
                                         std::vector<Command> commands, const Progress& progress);

}  // namespace rangezip::app
