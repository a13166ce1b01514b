#pragma once

#include <iosfwd>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "compare/stage_judge.h"

/// Verdicts on sessions as text and as JSON.
namespace rangezip::compare {

/// A session as one backend played it beside the reference.
struct JudgedSession {
  std::string name;                      ///< of the backend
  std::string renderer;                  ///< what draws
  std::vector<CommandVerdict> verdicts;  ///< of judge_session()

  [[nodiscard]] bool is_identical() const {
    return verdicts.empty() || verdicts.back().identical();
  }
};

/// For each command which stages are equal, then the first difference, one a line.
/// @param commands their names, in the session's order; at least as many as verdicts
void print_session(std::ostream& out, std::span<const std::string> commands,
                   const std::string& reference, const JudgedSession& judged);

/// The same with all counts; docs/command-line.md names the members.
[[nodiscard]] nlohmann::ordered_json json_of(std::span<const std::string> commands,
                                             const JudgedSession& judged);

}  // namespace rangezip::compare
