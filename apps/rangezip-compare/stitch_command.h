#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>

#include "core/base/progress.h"

namespace rangezip::compare {

struct StitchCommand {
  std::filesystem::path session;
  std::string backend = "cpu";
  std::uint64_t seed = 1;                     ///< of the segments that are chosen
  std::optional<std::filesystem::path> json;  ///< the verdicts as JSON
};

/// Plays a session, judges every stitch and every mesh with CGAL, and prints what it found.
/// @return true if all limits are kept (StitchSummary::is_good())
/// @throws IoError if a file cannot be read or the session cannot be played, OutputError if the
///     report cannot be written, BackendError if the backend is unknown or fails, Cancelled.
bool run_stitch_command(const StitchCommand& command, std::ostream& out, const Progress& progress);

}  // namespace rangezip::compare
