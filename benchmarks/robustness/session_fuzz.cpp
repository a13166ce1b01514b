// Is the mesh of every random session clean after each of its commands? Draws sessions from a seed
// (tests/support/random_sessions.h), runs them on all cores, and counts by cause what CGAL and the
// coverage of pixels and points say against the mesh after each stitch.
//   session_fuzz [--sessions N] [--first K] [--seed S] [--json FILE] [--revision NAME]
//       sessions K, K + 1, ... of the seed. Exit code 1 if anything is wrong; sessions with a fault
//       are printed as they are met.
//   session_fuzz --seed S --session K    that one alone, command by command

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/report.h"
#include "core/base/parallel.h"
#include "tests/support/random_sessions.h"
#include "tests/support/session_judge.h"

namespace {

using namespace rangezip;
using nlohmann::ordered_json;
using Counts = std::map<std::string, std::size_t>;

struct Options {
  std::uint64_t sessions = 10'000;
  std::uint64_t first = 0;
  std::uint64_t seed = 1;
  std::optional<std::uint64_t> session;
  benchmark::ReportOptions report;
};

/// Of all sessions, or of those of one model or way of stitching.
struct Tally {
  std::size_t sessions = 0;
  std::size_t commands = 0;
  std::size_t faulty_commands = 0;
  Counts faults;
};

struct Result {
  Tally total;
  std::map<std::string, Tally> by_model;
  std::map<std::string, Tally> by_kind;
  Counts repairs;         ///< faces that the stitches rolled back by themselves
  std::size_t faces = 0;  ///< of the last meshes
};

void add(const Counts& from, Counts& to) {
  for (const auto& [name, count] : from)
    to[name] += count;
}

/// The rest of a line that begins with the command.
void print_causes(const sessions::Step& step) {
  for (const auto& [cause, amount] : step.faults.by_cause()) {
    if (amount > 0) std::printf(" %s %zu", cause.c_str(), amount);
  }
  std::printf(" %s\n", step.what.c_str());
}

void print_faults(std::uint64_t number, const sessions::Outcome& outcome) {
  for (const sessions::Step& step : outcome.steps) {
    if (!step.faults.any()) continue;
    std::printf("session %llu, %s:", static_cast<unsigned long long>(number), step.kind.c_str());
    print_causes(step);
  }
  std::fflush(stdout);
}

void count(const std::string& model, const sessions::Outcome& outcome, Result& result) {
  ++result.total.sessions;
  ++result.by_model[model].sessions;
  result.faces += outcome.faces;
  add(outcome.repairs, result.repairs);
  for (const sessions::Step& step : outcome.steps) {
    for (Tally* tally : {&result.total, &result.by_model[model], &result.by_kind[step.kind]}) {
      ++tally->commands;
      tally->faulty_commands += step.faults.any() ? 1 : 0;
      add(step.faults.by_cause(), tally->faults);
    }
  }
}

/// In blocks, so that the counts are added in the order of the sessions.
Result run(const Options& options) {
  constexpr std::uint64_t kBlock = 64;
  Result result;
  for (std::uint64_t begin = 0; begin < options.sessions; begin += kBlock) {
    const std::uint64_t size = std::min(kBlock, options.sessions - begin);
    std::vector<std::string> models(size);
    std::vector<sessions::Outcome> outcomes(size);
    parallel_for(size, 1, [&](std::size_t from, std::size_t to) {
      for (std::size_t i = from; i < to; ++i) {
        const auto session = sessions::make_session(options.seed, options.first + begin + i);
        models[i] = session.model;
        outcomes[i] = sessions::run_session(session);
      }
    });
    for (std::size_t i = 0; i < size; ++i) {
      print_faults(options.first + begin + i, outcomes[i]);
      count(models[i], outcomes[i], result);
    }
    std::fprintf(stderr, "\r%zu sessions, %zu faulty commands of %zu ", result.total.sessions,
                 result.total.faulty_commands, result.total.commands);
  }
  std::fprintf(stderr, "\n");
  return result;
}

void print(const Result& result) {
  for (const auto& [cause, amount] : result.total.faults)
    std::printf("%-20s %zu\n", cause.c_str(), amount);
  for (const auto& [name, amount] : result.repairs)
    std::printf("in all stitches: %-20s %zu\n", name.c_str(), amount);
}

void show(const Options& options) {
  const auto session = sessions::make_session(options.seed, *options.session);
  std::printf("%s, %zu commands\n", session.model.c_str(), session.commands.size());
  for (const sessions::Step& step : sessions::run_session(session).steps) {
    std::printf("%-16s", step.kind.c_str());
    print_causes(step);
  }
}

ordered_json to_json(const Tally& tally) {
  return {{"sessions", tally.sessions},
          {"commands", tally.commands},
          {"faulty_commands", tally.faulty_commands},
          {"faults", tally.faults}};
}

ordered_json to_json(const Options& options, const Result& result, double seconds) {
  ordered_json json = benchmark::describe_run("session_fuzz", options.report.revision);
  json["build_type"] = RANGEZIP_BUILD_TYPE;
  json["seconds"] = std::round(seconds);
  json["seed"] = options.seed;
  json["first"] = options.first;
  json.update(to_json(result.total));
  json["faces_of_last_meshes"] = result.faces;
  json["rolled_back"] = result.repairs;
  for (const auto& [kind, tally] : result.by_kind)
    json["by_command"][kind] = to_json(tally);
  for (const auto& [model, tally] : result.by_model)
    json["by_model"][model] = to_json(tally);
  return json;
}

Options parse(const std::vector<std::string>& arguments) {
  Options options;
  const auto set = [&](const std::string& name, const std::string& value) {
    if (name == "--sessions") {
      options.sessions = std::stoull(value);
    } else if (name == "--first") {
      options.first = std::stoull(value);
    } else if (name == "--seed") {
      options.seed = std::stoull(value);
    } else if (name == "--session") {
      options.session = std::stoull(value);
    } else {
      return false;
    }
    return true;
  };
  options.report = benchmark::read_options(arguments, set);
  return options;
}

/// @return the exit code
int run_and_report(const Options& options) {
  if (options.session) {
    show(options);
    return 0;
  }
  const auto start = std::chrono::steady_clock::now();
  const Result result = run(options);
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  print(result);
  benchmark::write_report(options.report, to_json(options, result, taken.count()));
  std::printf("%zu sessions of %zu commands in %.0f s: %zu faulty commands\n",
              result.total.sessions, result.total.commands, taken.count(),
              result.total.faulty_commands);
  return result.total.faulty_commands == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  return rangezip::benchmark::run_program(
      "session_fuzz", argc, argv,
      [](const std::vector<std::string>& arguments) { return run_and_report(parse(arguments)); });
}
