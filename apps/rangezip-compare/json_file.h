#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace rangezip::compare {

/// Whether a report can be put there, asked before the work starts.
/// @throws OutputError if the name does not end in .json, the folder is missing, or the file or
///     folder is not writable.
void check_json_place(const std::filesystem::path& path);

/// Writes a report, in full or not at all. @throws OutputError if it cannot be written.
void write_json(const std::filesystem::path& path, const nlohmann::ordered_json& json);

}  // namespace rangezip::compare
