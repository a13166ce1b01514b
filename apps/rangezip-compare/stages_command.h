#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace rangezip::compare {

struct StagesCommand {
  std::filesystem::path session;
  std::vector<std::string> backends;  ///< the first is the reference
};

/// Plays a session with each backend beside the first one, prints for each command which stages are
/// equal, and names the first that is not.
/// @return true if all stages are equal, bit for bit
/// @throws UsageError without two backends, IoError if a file cannot be read or the session cannot
///     be played, BackendError if a backend is unknown or fails.
bool run_stages_command(const StagesCommand& command, std::ostream& out);

}  // namespace rangezip::compare
