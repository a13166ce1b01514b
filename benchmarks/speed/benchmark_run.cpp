#include "benchmarks/speed/benchmark_run.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <optional>

#include "benchmarks/report.h"
#include "core/base/error.h"
#include "core/io/atomic_file.h"

namespace rangezip::benchmark {

namespace {

using Json = nlohmann::ordered_json;

bool contains(const std::vector<std::string>& texts, const std::string& text) {
  return std::find(texts.begin(), texts.end(), text) != texts.end();
}

std::string usage(const std::string& program, const std::vector<std::string>& parts) {
  std::string text = "\nusage: " + program +
                     " [quick|full] [--only WHAT]... [--json FILE] [--revision TEXT]\nWHAT:";
  for (const std::string& part : parts)
    text += " " + part;
  return text;
}

}  // namespace

bool RunOptions::wants(const std::string& part) const {
  return only.empty() || contains(only, part);
}

RunOptions parse_run_options(const std::string& program, const std::vector<std::string>& parts,
                             const std::vector<std::string>& arguments) {
  const auto refuse = [&](const std::string& reason) {
    throw InvalidArgument(reason + usage(program, parts));
  };
  RunOptions options;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    const auto value = [&]() -> const std::string& {
      if (i + 1 == arguments.size()) refuse(argument + " needs a value");
      return arguments[++i];
    };
    if (argument == "quick" || argument == "full") {
      options.is_full = argument == "full";
    } else if (argument == "--json") {
      options.json = value();
    } else if (argument == "--revision") {
      options.revision = value();
    } else if (argument == "--only") {
      options.only.push_back(value());
      if (!contains(parts, options.only.back()))
        refuse("--only does not know " + options.only.back());
    } else {
      refuse("unknown argument " + argument);
    }
  }
  return options;
}

void run_and_store(const std::string& program, const RunOptions& options,
                   const std::function<void(Results& results, Json& report)>& run) {
  std::optional<AtomicFile> file;  // a place that cannot be written shows before the long run
  if (!options.json.empty()) file.emplace(options.json);
  Json report = describe_run(program, options.revision);
  report["extent"] = options.is_full ? "full" : "quick";
  report["only"] = options.only;
  report["load"] = {load_average()};
  report["notes"] = Json::array();
  Results results;
  run(results, report);
  for (const Json& note : report["notes"])
    std::printf("%s\n", note.get<std::string>().c_str());
  report["load"].push_back(load_average());
  report["rows"] = results.rows();
  if (file) {
    file->write(report.dump(1) + "\n");
    file->commit();
  }
}

int exit_code_of(const std::string& program, const std::function<void()>& work) {
  try {
    work();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", program.c_str(), error.what());
    return 1;
  }
  return 0;
}

}  // namespace rangezip::benchmark
