#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.h"

namespace rangezip::compare {

struct StagesCommand {
  std::filesystem::path session;
  std::vector<std::string> backends;          ///< the first is the reference
  std::optional<std::filesystem::path> json;  ///< the verdicts as JSON
};

/// Plays a session with each backend beside the first one, prints for each command which stages are
/// equal, and names the first that is not.
/// @return true if all stages are equal, bit for bit
/// @throws UsageError without two backends, IoError if a file cannot be read or the session cannot
///     be played, OutputError if the report cannot be written, BackendError if a backend is unknown
///     or fails, Cancelled.
bool run_stages_command(const StagesCommand& command, std::ostream& out, const Progress& progress);

}  // namespace rangezip::compare
