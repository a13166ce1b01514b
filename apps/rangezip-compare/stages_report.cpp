#include "apps/rangezip-compare/stages_report.h"

#include <ostream>

namespace rangezip::compare {

namespace {

using Json = nlohmann::ordered_json;

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

Json json_of(const StageVerdict& stage) {
  Json json{{"stage", stage.name}, {"compared", stage.compared}, {"different", stage.different}};
  if (!stage.identical()) json["first"] = stage.first;
  return json;
}

}  // namespace

void print_session(std::ostream& out, std::span<const std::string> commands,
                   const std::string& reference, const JudgedSession& judged) {
  const auto& verdicts = judged.verdicts;
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    out << "command " << i << ", " << commands[i] << '\n';
    print_command(out, verdicts[i]);
  }
  out << judged.name << " against " << reference << ": ";
  if (judged.is_identical()) {
    out << verdicts.size() << (verdicts.size() == 1 ? " command" : " commands")
        << ", all stages equal\n";
    return;
  }
  const StageVerdict& stage = verdicts.back().first_difference();
  out << "first difference: command " << verdicts.size() - 1 << ", " << stage.name << ", "
      << stage.first << '\n';
}

Json json_of(std::span<const std::string> commands, const JudgedSession& judged) {
  Json json{
      {"name", judged.name}, {"renderer", judged.renderer}, {"identical", judged.is_identical()}};
  if (!judged.is_identical()) {
    const StageVerdict& stage = judged.verdicts.back().first_difference();
    json["first_difference"] = {
        {"command", judged.verdicts.size() - 1}, {"stage", stage.name}, {"place", stage.first}};
  }
  json["commands"] = Json::array();
  for (std::size_t i = 0; i < judged.verdicts.size(); ++i) {
    Json stages = Json::array();
    for (const StageVerdict& stage : judged.verdicts[i].stages)
      stages.push_back(json_of(stage));
    json["commands"].push_back({{"command", commands[i]}, {"stages", std::move(stages)}});
  }
  return json;
}

}  // namespace rangezip::compare
