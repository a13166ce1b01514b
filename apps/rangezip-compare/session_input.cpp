#include "apps/rangezip-compare/session_input.h"

#include <algorithm>
#include <iterator>
#include <variant>

#include "core/base/error.h"
#include "core/io/input_file.h"

namespace rangezip::compare {

namespace {

std::string name_of(const Command& command) {
  struct Name {
    std::string operator()(const AddScan&) const { return "scan"; }
    std::string operator()(const EraseRegion&) const { return "erase"; }
    std::string operator()(const ErasePlaces&) const { return "erase_places"; }
    std::string operator()(const SmoothMesh&) const { return "smooth"; }
    std::string operator()(const FillMeshHoles&) const { return "fill"; }
    std::string operator()(const DropUnsupported&) const { return "drop_unsupported"; }
    std::string operator()(const FinishMesh&) const { return "finish"; }
    std::string operator()(const TurnToScanners&) const { return "turn_to_scanners"; }
    std::string operator()(const UndoSteps&) const { return "undo"; }
  };
  return std::visit(Name{}, command);
}

}  // namespace

JudgeableSession read_judgeable_session(const std::filesystem::path& path,
                                        const Progress& progress) {
  const auto read = [&](const auto& paths) { return read_scene(paths, progress).scene; };
  try {
    SessionFile file = read_session(path);
    app::SessionStart start = app::read_session_start(path, file, read, progress);
    return {.file = std::move(file), .start = std::move(start)};
  } catch (const TopologyError& error) {
    throw IoError(path.string() + ": /initial_mesh: " + error.what());
  }
}

std::vector<std::string> names_of(std::span<const Command> commands) {
  std::vector<std::string> names;
  std::transform(commands.begin(), commands.end(), std::back_inserter(names), name_of);
  return names;
}

}  // namespace rangezip::compare
