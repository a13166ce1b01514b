#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/session/command.h"

namespace rangezip {

/// A file that a session reads, and how to know that it is still the same.
struct SessionInput {
  std::filesystem::path path;         ///< absolute or from the current folder; the session file
                                      ///< holds it relative to its own folder
  std::optional<std::uint64_t> hash;  ///< hash_file(); absent: not checked

  friend bool operator==(const SessionInput&, const SessionInput&) = default;
};

/// All it takes to make the same mesh again.
struct SessionFile {
  std::vector<SessionInput> inputs;          ///< in the order of the scene
  std::vector<SessionInput> also_read;       ///< files that the inputs name (scans of a .conf)
  std::optional<SessionInput> initial_mesh;  ///< the mesh into which the first scan is stitched
  std::optional<std::size_t> points;         ///< of the scene; absent: not checked
  std::optional<std::size_t> triangles;      ///< of the scene; absent: not checked
  std::vector<Command> commands;
};

inline constexpr int kSessionFileVersion = 1;

/// Can write_session() name these files in `path`? For a refusal before any work.
/// @throws IoError that names the first of the `inputs` whose path is not UTF-8, as JSON must be.
void check_session_paths(const std::filesystem::path& path,
                         std::span<const std::filesystem::path> inputs);

/// Writes JSON after docs/session-schema.json. Every number is written with the digits that give
/// back the same double. Written beside the target and renamed, so a failure leaves no partial
/// file.
/// @throws IoError if the file cannot be written in full or a path is not UTF-8; InvalidArgument if
/// a
///     number is not finite where the schema wants one.
void write_session(const std::filesystem::path& path, const SessionFile& session);

/// Reads what write_session() or a person wrote: a member left out has the default of its Command;
/// a camera may be given by `look_at` instead of a matrix.
/// @throws IoError naming the file and, for anything wrong, its place as a JSON pointer
///     ("/commands/3/median/radius"), the rule and the value: syntax, an unknown or repeated key, a
///     wrong type, a number out of range, another version.
[[nodiscard]] SessionFile read_session(const std::filesystem::path& path);

/// Compares the content of every file that has a hash with it.
/// @throws IoError if one is missing, unreadable or changed.
/// @throws Cancelled if `progress` says so.
void check_session_inputs(const SessionFile& session, const Progress& progress = {});

/// The JSON Schema (2020-12) of these files, made from the same list of fields that reader and
/// writer use; docs/session-schema.json is this text.
[[nodiscard]] std::string session_schema();

}  // namespace rangezip
