#pragma once

#include <filesystem>
#include <stop_token>
#include <string>

#include "core/io/session_file.h"

namespace rangezip::app {

/// The program rangezip-compare, as it is installed beside this one (or built beside it).
/// @throws UsageError if it is not there
[[nodiscard]] std::filesystem::path find_referee();

/// Where the session lies while the referee judges: beside `output`.
[[nodiscard]] std::filesystem::path session_for_referee(const std::filesystem::path& output);

/// Lets the referee play the session and judge every stitch with CGAL; what it prints goes to
/// standard output unless `quiet`. Meanwhile the session lies at session_for_referee(output).
/// @param backend draws the scans
/// @throws NotVerified if a stitch is not good, OutputError if the session cannot be written,
///     Cancelled if it was interrupted or is to stop, Error if it failed.
void let_referee_judge(const std::filesystem::path& referee, const SessionFile& session,
                       const std::filesystem::path& output, const std::string& backend, bool quiet,
                       const std::stop_token& stop);

}  // namespace rangezip::app
