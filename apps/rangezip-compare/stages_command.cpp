#include "apps/rangezip-compare/stages_command.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>

#include "apps/rangezip-compare/json_file.h"
#include "apps/rangezip-compare/session_input.h"
#include "apps/rangezip-compare/stages_report.h"
#include "apps/rangezip/backend.h"
#include "apps/rangezip/exit_code.h"
#include "compare/stage_judge.h"
#include "core/base/error.h"

namespace rangezip::compare {

namespace {

using Json = nlohmann::ordered_json;

std::vector<CommandVerdict> judge(const StagesCommand& command, const JudgeableSession& session,
                                  Rasterizer& reference, Rasterizer& candidate,
                                  const Progress& progress) {
  try {
    return judge_session(session.start.scene, session.start.mesh, session.file.commands, reference,
                         candidate, progress);
  } catch (const InvalidArgument& error) {
    throw IoError(command.session.string() + ": " + error.what());
  }
}

Json report_of(const StagesCommand& command, std::span<const std::string> names,
               const Rasterizer& reference, const std::vector<JudgedSession>& candidates) {
  Json json{
      {"session", command.session.string()},
      {"commands", names.size()},
      {"reference", {{"name", command.backends.front()}, {"renderer", reference.info().name}}},
      {"candidates", Json::array()}};
  for (const JudgedSession& judged : candidates)
    json["candidates"].push_back(json_of(names, judged));
  return json;
}

}  // namespace

bool run_stages_command(const StagesCommand& command, std::ostream& out, const Progress& progress) {
  if (command.backends.size() < 2) {
    throw app::UsageError("stages: --backends must name two at least");
  }
  if (command.json) check_json_place(*command.json);
  std::vector<std::unique_ptr<Rasterizer>> rasterizers;
  for (const std::string& name : command.backends)
    rasterizers.push_back(app::make_rasterizer(name));
  const JudgeableSession session = read_judgeable_session(command.session, progress);
  const std::vector<std::string> names = names_of(session.file.commands);

  Rasterizer& reference = *rasterizers.front();
  std::vector<JudgedSession> candidates;
  for (std::size_t i = 1; i < rasterizers.size(); ++i) {
    candidates.push_back(
        {.name = command.backends[i],
         .renderer = rasterizers[i]->info().name,
         .verdicts = judge(command, session, reference, *rasterizers[i], progress)});
    print_session(out, names, command.backends.front(), candidates.back());
  }
  if (command.json) write_json(*command.json, report_of(command, names, reference, candidates));
  return std::all_of(candidates.begin(), candidates.end(),
                     std::mem_fn(&JudgedSession::is_identical));
}

}  // namespace rangezip::compare
