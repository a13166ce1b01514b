#include "apps/rangezip-compare/stages_command.h"

#include <memory>
#include <ostream>

#include "apps/rangezip/backend.h"
#include "apps/rangezip/exit_code.h"
#include "apps/rangezip/session_start.h"
#include "compare/stage_judge.h"
#include "core/base/error.h"
#include "core/io/input_file.h"
#include "core/io/session_file.h"

namespace rangezip::compare {

namespace {

/// "scan": the command's name in the session file.
std::string name_of(const Command& command) {
  struct Name {
    std::string operator()(const AddScan&) const { return "scan"; }
    std::string operator()(const EraseRegion&) const { return "erase"; }
    std::string operator()(const SmoothMesh&) const { return "smooth"; }
    std::string operator()(const FillMeshHoles&) const { return "fill"; }
    std::string operator()(const FinishMesh&) const { return "finish"; }
    std::string operator()(const UndoSteps&) const { return "undo"; }
  };
  return std::visit(Name{}, command);
}

void print_command(std::ostream& out, const CommandVerdict& verdict) {
  for (const StageVerdict& stage : verdict.stages) {
    out << "  " << stage.name << ": ";
    if (stage.identical()) {
      out << stage.compared << " equal\n";
    } else {
      out << stage.different << " of " << stage.compared << " differ, first " << stage.first
          << '\n';
    }
  }
}

/// @return whether all is equal
bool print_session(std::ostream& out, const SessionFile& file, const std::string& pair,
                   const std::vector<CommandVerdict>& verdicts) {
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    out << "command " << i << ", " << name_of(file.commands[i]) << '\n';
    print_command(out, verdicts[i]);
  }
  if (verdicts.empty() || verdicts.back().identical()) {
    out << pair << ": " << verdicts.size() << " commands, all stages equal\n";
    return true;
  }
  const StageVerdict& stage = verdicts.back().first_difference();
  out << pair << ": first difference: command " << verdicts.size() - 1 << ", " << stage.name << ", "
      << stage.first << '\n';
  return false;
}

std::vector<CommandVerdict> judge(const StagesCommand& command, const SessionFile& file,
                                  const app::SessionStart& start, Rasterizer& reference,
                                  Rasterizer& candidate) {
  try {
    return judge_session(start.scene, start.mesh, file.commands, reference, candidate);
  } catch (const InvalidArgument& error) {
    throw IoError(command.session.string() + ": " + error.what());
  }
}

}  // namespace

bool run_stages_command(const StagesCommand& command, std::ostream& out) {
  if (command.backends.size() < 2) {
    throw app::UsageError("stages: --backends must name two at least");
  }
  std::vector<std::unique_ptr<Rasterizer>> rasterizers;
  for (const std::string& name : command.backends)
    rasterizers.push_back(app::make_rasterizer(name));
  const SessionFile file = read_session(command.session);
  const app::SessionStart start = app::read_session_start(
      command.session, file, [](const auto& paths) { return read_scene(paths).scene; });

  bool all_equal = true;
  for (std::size_t i = 1; i < rasterizers.size(); ++i) {
    const std::string pair = command.backends[i] + " against " + command.backends.front();
    const auto verdicts = judge(command, file, start, *rasterizers.front(), *rasterizers[i]);
    all_equal = print_session(out, file, pair, verdicts) && all_equal;
  }
  return all_equal;
}

}  // namespace rangezip::compare
