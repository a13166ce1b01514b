#include "apps/rangezip-compare/stitch_command.h"

#include <nlohmann/json.hpp>
#include <ostream>

#include "apps/rangezip-compare/json_file.h"
#include "apps/rangezip-compare/session_input.h"
#include "apps/rangezip-compare/stitch_report.h"
#include "apps/rangezip/backend.h"
#include "compare/stitch_judge.h"
#include "core/base/error.h"

namespace rangezip::compare {

namespace {

std::vector<StitchStep> judge(const StitchCommand& command, const JudgeableSession& session,
                              Rasterizer& rasterizer, const Progress& progress) {
  try {
    return judge_stitches(session.start.scene, session.start.mesh, session.file.commands,
                          rasterizer, {.seed = command.seed}, progress);
  } catch (const InvalidArgument& error) {
    throw IoError(command.session.string() + ": " + error.what());
  }
}

}  // namespace

bool run_stitch_command(const StitchCommand& command, std::ostream& out, const Progress& progress) {
  if (command.json) check_json_place(*command.json);
  const auto rasterizer = app::make_rasterizer(command.backend);
  const JudgeableSession session = read_judgeable_session(command.session, progress);
  const std::vector<std::string> names = names_of(session.file.commands);
  const std::vector<StitchStep> steps = judge(command, session, *rasterizer, progress);

  const StitchLimits limits;
  print_stitches(out, names, steps, limits);
  if (command.json) {
    nlohmann::ordered_json json{{"session", command.session.string()}};
    json.update(json_of(names, steps, limits));
    write_json(*command.json, json);
  }
  return summarize_session(steps).is_good(limits);
}

}  // namespace rangezip::compare
