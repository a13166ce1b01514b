#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "benchmarks/speed/measure.h"

namespace rangezip::benchmark {

/// What a benchmark of speed is asked for:
///   PROGRAM [quick|full] [--only WHAT]... [--json FILE] [--revision TEXT]
struct RunOptions {
  bool is_full = false;
  std::vector<std::string> only;  ///< empty: all parts
  std::string json;               ///< where the report is stored; empty: nowhere
  std::string revision = "unknown";

  [[nodiscard]] bool wants(const std::string& part) const;
};

/// @param parts what --only may name
/// @throws InvalidArgument with the usage for anything else
[[nodiscard]] RunOptions parse_run_options(const std::string& program,
                                           const std::vector<std::string>& parts,
                                           const std::vector<std::string>& arguments);

/// Measures by `run`, which adds rows, and notes of what was left out and why; stores the report:
/// what describe_run() says, extent, load before and after, notes, rows, and what `run` adds.
/// @throws Error if the report cannot be written, before the long run where that shows then
void run_and_store(
    const std::string& program, const RunOptions& options,
    const std::function<void(Results& results, nlohmann::ordered_json& report)>& run);

/// Carries out `work` of a program. @return 0, or 1 if it throws: the error stream says what
int exit_code_of(const std::string& program, const std::function<void()>& work);

}  // namespace rangezip::benchmark
