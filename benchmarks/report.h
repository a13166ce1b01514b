#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace rangezip::benchmark {

/// Processes that want to run, over the last minute; -1: the machine does not say.
[[nodiscard]] double load_average();

/// What the figures of a run depend on: program, date, revision, compiler, processor, threads.
/// @param revision what the caller says that the program was built from
[[nodiscard]] nlohmann::ordered_json describe_run(const std::string& program,
                                                  const std::string& revision);

/// What every program that measures is told about its report.
struct ReportOptions {
  std::string json;  ///< the file it goes to; empty: none
  std::string revision = "unknown";
};

/// Reads a command line of pairs `--name value`. Those that are not of the report go to
/// set(name, value), which returns whether it knows the name.
/// @throws std::runtime_error for an unknown name and a missing value
[[nodiscard]] ReportOptions read_options(
    const std::vector<std::string>& arguments,
    const std::function<bool(const std::string& name, const std::string& value)>& set);

/// Writes the report if it was asked for. @throws std::runtime_error if that fails
void write_report(const ReportOptions& options, const nlohmann::ordered_json& report);

/// The body of main(): what run() returns for the arguments, or 2 after an exception, whose text is
/// printed.
int run_program(const std::string& name, int argc, char** argv,
                const std::function<int(const std::vector<std::string>& arguments)>& run);

}  // namespace rangezip::benchmark
