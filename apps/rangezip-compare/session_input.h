#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "apps/rangezip/session_start.h"
#include "core/base/progress.h"
#include "core/io/session_file.h"
#include "core/session/command.h"

namespace rangezip::compare {

/// A session and what it begins with.
struct JudgeableSession {
  SessionFile file;
  app::SessionStart start;
};

/// @throws IoError naming file and place if the session or one of its inputs cannot be read.
[[nodiscard]] JudgeableSession read_judgeable_session(const std::filesystem::path& path,
                                                      const Progress& progress);

/// What a session file calls the commands: "scan", "finish".
[[nodiscard]] std::vector<std::string> names_of(std::span<const Command> commands);

}  // namespace rangezip::compare
