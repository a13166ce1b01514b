#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace rangezip::benchmark {

/// Processes that want to run, over the last minute; -1: the machine does not say.
[[nodiscard]] double load_average();

/// What the figures of a run depend on: program, date, revision, compiler, processor, threads.
/// @param revision what the caller says that the program was built from
[[nodiscard]] nlohmann::ordered_json describe_run(const std::string& program,
                                                  const std::string& revision);

}  // namespace rangezip::benchmark
