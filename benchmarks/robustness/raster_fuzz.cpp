// Draws random scenes with every set of vector instructions and 1 to 8 threads, or with a backend,
// and compares depth and ID of every pixel, and all ten sums, with scalar code in one thread.
//   raster_fuzz [--against BACKEND [--strategy NAME]] [--pixels N] [--seed S] [--threads T]
//               [--json FILE] [--revision NAME]
//       until N pixels (default 1e9) are compared, with up to T threads (default 8); then shows
//       that rasterizers with wrong rules are noticed. Exit code 1 at the first difference, or if a
//       wrong rule is not noticed. BACKEND has a name of `rangezip --backend`, such as gl:osmesa,
//       the strategy one of `rangezip-compare draw --strategy`, such as compute.
//   raster_fuzz --seed S --scene K    that scene alone, with each number of threads. A difference
//       that does not come back needs what the scenes before K left in the working memory.
//   raster_fuzz --control NAME        that wrong rule alone

#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/rangezip/backend.h"
#include "benchmarks/report.h"
#include "tests/support/backends.h"
#include "tests/support/raster_fuzz.h"
#include "tests/support/threads.h"
#include "tests/support/wrong_rasterizers.h"

namespace {

using namespace rangezip;
using nlohmann::ordered_json;

struct Options {
  std::uint64_t pixels = 1'000'000'000;
  std::uint64_t seed = 1;
  int threads = 8;
  std::string against;   ///< empty: the CPU, with all its sets of instructions
  std::string strategy;  ///< of OpenGL; empty: the backend chooses
  std::optional<std::uint64_t> scene;
  std::string control;
  benchmark::ReportOptions report;
};

/// What was compared; pixels once for each operation and rasterizer.
struct Count {
  std::uint64_t scenes = 0;
  std::uint64_t pixels = 0;
  std::uint64_t covered = 0;  ///< pixels that hold something
  std::uint64_t primitives = 0;
};

struct Failure {
  std::uint64_t scene = 0;
  std::string family;
  std::string backend;
  int threads = 0;
  fuzz::Difference difference;
  bool is_repeated = false;  ///< by a fresh rasterizer
};

struct Result {
  std::vector<std::string> renderers;  ///< of the candidates, with their drivers
  std::map<std::string, Count> families;
  std::map<std::string, std::map<int, std::uint64_t>> pixels;  ///< by backend and threads
  Count total;
  std::optional<Failure> failure;
};

/// A backend that is held against the reference. Kept from scene to scene, as a program does.
struct Candidate {
  Backend backend;
  std::unique_ptr<Rasterizer> rasterizer;
};

std::vector<Backend> backends_of(const Options& options) {
  if (options.against.empty()) return all_backends();
  const auto make = [options] { return app::make_rasterizer(options.against, options.strategy); };
  return {{options.against, make, !app::is_gl(options.against)}};
}

std::vector<Candidate> make_candidates(const Options& options) {
  std::vector<Candidate> candidates;
  for (const Backend& backend : backends_of(options))
    candidates.push_back({backend, backend.make()});
  return candidates;
}

/// The most that make a difference to a candidate.
int most_threads(const Options& options, const Candidate& candidate) {
  return candidate.backend.uses_threads ? options.threads : 1;
}

std::optional<fuzz::Difference> try_out(Rasterizer& rasterizer, int threads,
                                        const fuzz::Case& drawn, fuzz::Drawings& found) {
  run_with_exactly(threads, [&] { fuzz::draw(rasterizer, drawn, found); });
  return fuzz::find_difference(drawn, found);
}

/// Draws a scene with one candidate and one number of threads, and counts it.
void compare(const Candidate& candidate, int threads, std::uint64_t scene, const fuzz::Case& drawn,
             fuzz::Drawings& found, Result& result) {
  const auto difference = try_out(*candidate.rasterizer, threads, drawn, found);
  for (Count* count : {&result.families[drawn.family], &result.total}) {
    count->pixels += drawn.pixels();
    count->covered += drawn.covered();
  }
  result.pixels[candidate.backend.name][threads] += drawn.pixels();
  if (!difference) return;
  const auto fresh = candidate.backend.make();
  result.failure = Failure{scene,   drawn.family, candidate.backend.name,
                           threads, *difference,  bool(try_out(*fresh, threads, drawn, found))};
}

void count_scene(const fuzz::Case& drawn, Result& result) {
  for (Count* count : {&result.families[drawn.family], &result.total}) {
    ++count->scenes;
    count->primitives += drawn.primitives();
  }
}

/// Every candidate with one random number of threads.
void run_scene(const Options& options, std::uint64_t scene,
               const std::vector<Candidate>& candidates, Rasterizer& reference,
               fuzz::Drawings& found, Result& result) {
  const fuzz::Case drawn = fuzz::make_case(options.seed, scene, reference);
  shapes::Random random(options.seed ^ (scene << 16U));
  count_scene(drawn, result);
  for (const Candidate& candidate : candidates) {
    const auto most = static_cast<std::uint64_t>(most_threads(options, candidate));
    const auto choice = random.bits() % most;
    compare(candidate, static_cast<int>(choice) + 1, scene, drawn, found, result);
    if (result.failure) return;
  }
}

/// Every candidate with every number of threads.
void run_one_scene(const Options& options, const std::vector<Candidate>& candidates,
                   Rasterizer& reference, Result& result) {
  const fuzz::Case drawn = fuzz::make_case(options.seed, *options.scene, reference);
  fuzz::Drawings found;
  count_scene(drawn, result);
  for (const Candidate& candidate : candidates) {
    const int most = most_threads(options, candidate);
    for (int threads = 1; threads <= most && !result.failure; ++threads)
      compare(candidate, threads, *options.scene, drawn, found, result);
  }
}

void show_progress(const Options& options, const Result& result) {
  std::fprintf(
      stderr, "\r%5.1f %%  %llu scenes, %.3g pixels, %.3g primitives ",
      100.0 * static_cast<double>(result.total.pixels) / static_cast<double>(options.pixels),
      static_cast<unsigned long long>(result.total.scenes),
      static_cast<double>(result.total.pixels), static_cast<double>(result.total.primitives));
}

Result run(const Options& options) {
  const std::vector<Candidate> candidates = make_candidates(options);
  const auto reference = all_backends().front().make();
  Result result;
  for (const Candidate& candidate : candidates)
    result.renderers.push_back(candidate.rasterizer->info().name);
  if (options.scene) {
    run_one_scene(options, candidates, *reference, result);
    return result;
  }
  fuzz::Drawings found;
  for (std::uint64_t scene = 0; result.total.pixels < options.pixels && !result.failure; ++scene) {
    run_scene(options, scene, candidates, *reference, found, result);
    if (scene % 500 == 499) show_progress(options, result);
  }
  show_progress(options, result);
  std::fprintf(stderr, "\n");
  return result;
}

void print(const Options& options, const Failure& f) {
  std::printf(
      "DIFFERENCE: seed %llu scene %llu (%s), %s of %s with %d threads\n  %s\n"
      "  %zu pixels differ; a fresh rasterizer %s\n",
      static_cast<unsigned long long>(options.seed), static_cast<unsigned long long>(f.scene),
      f.family.c_str(), f.difference.operation.c_str(), f.backend.c_str(), f.threads,
      f.difference.text.c_str(), f.difference.pixels,
      f.is_repeated ? "differs too" : "does not differ");
}

/// The first scene of the run in which a pixel tells the wrong rasterizer from the reference.
std::optional<std::uint64_t> noticing_scene(const Options& options, const WrongRasterizer& wrong) {
  constexpr std::uint64_t kMostScenes = 500;
  const auto reference = all_backends().front().make();
  const auto rasterizer = wrong.make();
  fuzz::Drawings found;
  for (std::uint64_t scene = 0; scene < kMostScenes; ++scene) {
    const fuzz::Case drawn = fuzz::make_case(options.seed, scene, *reference);
    if (drawn.is_large && wrong.is_slow) continue;
    const auto difference = try_out(*rasterizer, 1, drawn, found);
    // The oracle does not count what is dropped, so reports do not prove anything.
    if (difference && difference->pixels > 0) return scene;
  }
  return {};
}

/// Runs the wrong rules that are asked for. @return one entry a rule
ordered_json run_controls(const Options& options, bool& all_noticed) {
  ordered_json rows = ordered_json::array();
  for (const WrongRasterizer& wrong : wrong_rasterizers(all_backends().front().make)) {
    if (!options.control.empty() && options.control != wrong.name) continue;
    const auto scene = noticing_scene(options, wrong);
    std::printf("wrong rule %-26s %s\n", wrong.name.c_str(),
                scene ? ("noticed in scene " + std::to_string(*scene)).c_str() : "NOT NOTICED");
    all_noticed = all_noticed && scene;
    rows.push_back({{"rule", wrong.name}, {"noticed", scene.has_value()}});
    if (scene) rows.back()["scene"] = *scene;
  }
  if (rows.empty()) throw std::runtime_error("there is no wrong rule named " + options.control);
  return rows;
}

ordered_json to_json(const Count& count) {
  return {{"scenes", count.scenes},
          {"pixels", count.pixels},
          {"covered_pixels", count.covered},
          {"primitives", count.primitives}};
}

ordered_json to_json(const Options& options, const Result& result, double seconds) {
  ordered_json json = benchmark::describe_run("raster_fuzz", options.report.revision);
  json["build_type"] = RANGEZIP_BUILD_TYPE;
  json["seconds"] = std::round(seconds);
  json["seed"] = options.seed;
  json["reference"] = "scalar code, 1 thread";
  json["against"] = result.renderers;
  json.update(to_json(result.total));
  json["differing_pixels"] = result.failure ? result.failure->difference.pixels : 0;
  json["identical"] = !result.failure;
  for (const auto& [family, count] : result.families)
    json["families"][family] = to_json(count);
  for (const auto& [backend, by_threads] : result.pixels) {
    for (const auto& [threads, pixels] : by_threads)
      json["pixels_by_backend_and_threads"][backend][std::to_string(threads)] = pixels;
  }
  return json;
}

Options parse(const std::vector<std::string>& arguments) {
  Options options;
  const auto set = [&](const std::string& name, const std::string& value) {
    if (name == "--pixels") {
      options.pixels = static_cast<std::uint64_t>(std::stod(value));  // 1e9 is easier to read
    } else if (name == "--seed") {
      options.seed = std::stoull(value);
    } else if (name == "--threads") {
      options.threads = std::stoi(value);
    } else if (name == "--against") {
      options.against = value;
    } else if (name == "--strategy") {
      options.strategy = value;
    } else if (name == "--scene") {
      options.scene = std::stoull(value);
    } else if (name == "--control") {
      options.control = value;
    } else {
      return false;
    }
    return true;
  };
  options.report = benchmark::read_options(arguments, set);
  if (options.threads < 1) throw std::runtime_error("--threads must be at least 1");
  if (!options.strategy.empty() && !app::is_gl(options.against)) {
    throw std::runtime_error("--strategy needs --against gl, or one that begins with gl:");
  }
  return options;
}

/// @return the exit code
int run_and_report(const Options& options) {
  bool all_noticed = true;
  if (!options.control.empty()) {
    run_controls(options, all_noticed);
    return all_noticed ? 0 : 1;
  }
  const auto start = std::chrono::steady_clock::now();
  const Result result = run(options);
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  if (result.failure) print(options, *result.failure);
  ordered_json json = to_json(options, result, taken.count());
  if (!options.scene) json["wrong_rules"] = run_controls(options, all_noticed);
  benchmark::write_report(options.report, json);
  std::printf("%llu pixels of %llu scenes compared in %.0f s: %s\n",
              static_cast<unsigned long long>(result.total.pixels),
              static_cast<unsigned long long>(result.total.scenes), taken.count(),
              result.failure ? "DIFFERENT" : "identical");
  return !result.failure && all_noticed ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  return rangezip::benchmark::run_program(
      "raster_fuzz", argc, argv,
      [](const std::vector<std::string>& arguments) { return run_and_report(parse(arguments)); });
}
