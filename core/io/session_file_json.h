#pragma once

// The three walks over the fields of a session's commands. Private to core/io.

#include <string>

#include <nlohmann/json.hpp>

#include "core/session/command.h"

namespace rangezip::session_file {

using Json = nlohmann::ordered_json;

/// A command with all its members.
/// @throws InvalidArgument if a number is not finite where it must be.
[[nodiscard]] Json json_of(const Command& command);

/// The command at `pointer` of a document.
/// @throws IoError "<pointer>: rule, got value" without the name of the file.
[[nodiscard]] Command command_of(const Json& json, const std::string& pointer);

/// Throws IoError "<pointer>: <rule>, got <value>".
[[noreturn]] void refuse(const std::string& pointer, const std::string& rule, const Json& value);

/// The document indented; what fits into 100 columns stays on one line.
[[nodiscard]] std::string pretty(const Json& json);

}  // namespace rangezip::session_file
