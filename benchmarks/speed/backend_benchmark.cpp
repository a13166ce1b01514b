// How fast each backend draws the same scenes: the CPU rasterizer with one thread and with all, and
// every OpenGL context that starts here by each strategy; upload, drawing and read-back apart, with
// the scene kept on the device and with nothing kept.
//   backend_benchmark [quick|full] [--only CONTEXT]... [--json FILE] [--revision TEXT]
// quick: the scenes with a target; full: also the ladder of sizes. CONTEXT: a name such as osmesa,
// or egl:0. Mesa's software renderer draws on the calling thread, so that processor time is that of
// one core, unless LP_NUM_THREADS says otherwise.
// The limits stand in the same run: reading and copying memory, and for each context the copy of
// one buffer of the device to another. Exact strategies must give the CPU rasterizer's image.
// benchmarks/backend_table.py makes tables of the JSON.

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/speed/backend_cases.h"
#include "benchmarks/speed/benchmark_run.h"
#include "benchmarks/speed/device_copy.h"
#include "core/base/error.h"
#include "raster_gl/context_list.h"
#include "raster_gl/gl_probe.h"

namespace rangezip::benchmark {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMillion = 1'000'000;
constexpr int kSize = 1024;

// The contexts.

constexpr const char* kMesaThreads = "LP_NUM_THREADS";

/// Before the first context: Mesa asks when it starts. @return its threads, "0": the calling one
std::string prepare_mesa() {
  constexpr int kKeepIfSet = 0;
  // Its software renderer takes code from the cache that was made for vectors of another width.
  setenv("MESA_SHADER_CACHE_DISABLE", "true", kKeepIfSet);
  setenv(kMesaThreads, "0", kKeepIfSet);
  return std::getenv(kMesaThreads);
}

bool is_software(const std::string& renderer) {
  constexpr std::array kNames{"llvmpipe", "softpipe", "SWR", "swrast"};
  return std::any_of(kNames.begin(), kNames.end(),
                     [&](const char* name) { return renderer.find(name) != std::string::npos; });
}

/// @throws BackendError if the context does not start
GlBackend probe_backend(const std::string& context, const std::string& mesa_threads) {
  const GlProbe found = probe(*make_gl_context(context));
  const bool software = is_software(found.renderer);
  return {.context = context,
          .renderer = found.renderer,
          .version = found.version,
          .is_software = software,
          .is_by_wall = !software || mesa_threads != "0"};
}

void start_strategies(GlBackend& backend, Json& notes) {
  for (const GlStrategy strategy :
       {GlStrategy::native, GlStrategy::fixed_function, GlStrategy::compute}) {
    try {
      backend.rasterizers.push_back(std::make_unique<TimedGl>(backend.context, strategy));
    } catch (const BackendError& error) {
      notes.push_back(backend.context + ", " + name_of(strategy) + ": " + error.what());
    }
  }
}

/// The contexts that are wanted, start, and are not an earlier one by another way: EGL's platform
/// without surfaces takes one of the devices.
std::vector<GlBackend> find_backends(const RunOptions& options, const std::string& mesa_threads,
                                     Json& notes) {
  std::vector<GlBackend> backends;
  for (const std::string& context : list_gl_contexts()) {
    if (!options.wants(context)) continue;
    try {
      GlBackend backend = probe_backend(context, mesa_threads);
      const auto same = std::find_if(backends.begin(), backends.end(), [&](const GlBackend& other) {
        return context == "egl:surfaceless" && other.renderer == backend.renderer &&
               other.version == backend.version;
      });
      if (same == backends.end()) {
        backends.push_back(std::move(backend));
      } else {
        notes.push_back(context + ": the same renderer as " + same->context + ", not measured");
      }
    } catch (const BackendError& error) {
      notes.push_back(context + ": " + error.what());
    }
  }
  return backends;
}

// The scenes.

constexpr Effort kEffort{.rounds = 2, .seconds_per_case = 0.05};

void measure_scene(Results& results, const GlBackend& backend, const Scene& scene) {
  std::vector<Case> cases = cpu_cases(scene);
  for (const auto& gl : backend.rasterizers) {
    for (Case& one : gl_cases(scene, backend, *gl))
      cases.push_back(std::move(one));
  }
  results.measure(cases, kEffort);
}

/// So large that starting a copy does not count.
std::size_t bytes_to_copy(const GlBackend& backend) {
  return (backend.is_software ? 10 : 100) * kMillion * sizeof(Vec3f);
}

void measure_limits(Results& results, const GlBackend& backend) {
  const Cloud cloud = make_cloud(10 * kMillion, Order::scan);
  std::vector<Case> cases = limits_of(bytes_of(cloud));
  for (Case& copy : device_copy_cases(backend.context, bytes_to_copy(backend), backend.is_by_wall))
    cases.push_back(std::move(copy));
  results.measure(cases, kEffort);
}

constexpr std::array kTrianglePixels{0.34, 1.4, 10.0, 400.0};

/// The scenes with a figure to reach, and a few beside them.
void measure_quick(Results& results, const GlBackend& backend) {
  const std::size_t count = backend.is_software ? kMillion : 10 * kMillion;
  const Cloud random = make_cloud(count, Order::random);
  for (const int point_size : {1, 3})
    measure_scene(results, backend, make_scene(random, point_size, kSize));
  measure_scene(results, backend, make_scene(random, 1, 2 * kSize));
  if (!backend.is_software)
    measure_scene(results, backend,
                  make_scene(make_cloud(100 * kMillion, Order::random), 1, 2 * kSize));
  measure_scene(results, backend, make_scene(make_cloud(count, Order::scan), 1, kSize));
  measure_scene(results, backend, make_scene(make_cloud(count / 10, Order::random), 1, kSize));
  const int size = backend.is_software ? kSize / 2 : kSize;
  for (const double pixels : kTrianglePixels)
    measure_scene(results, backend, make_scene(make_field(pixels, size), pixels, size));
}

void climb_points(Results& results, const GlBackend& backend) {
  std::vector<std::size_t> counts{kMillion / 10, kMillion, 10 * kMillion};
  if (!backend.is_software) counts.push_back(100 * kMillion);
  for (const std::size_t count : counts) {
    for (const Order order : {Order::random, Order::scan}) {
      const Cloud cloud = make_cloud(count, order);
      for (const int size : {512, 1024, 2048, 4096}) {
        for (const int point_size : {1, 3})
          measure_scene(results, backend, make_scene(cloud, point_size, size));
      }
    }
  }
}

void climb_triangles(Results& results, const GlBackend& backend) {
  constexpr std::size_t kMostInSoftware = 5 * kMillion;
  for (const double pixels : kTrianglePixels) {
    for (const int size : {512, 1024, 2048, 4096}) {
      const Field field = make_field(pixels, size);
      if (backend.is_software && field.triangles.size() > kMostInSoftware) continue;
      measure_scene(results, backend, make_scene(field, pixels, size));
    }
  }
}

// The program.

void run(const RunOptions& options, const std::string& mesa_threads, Results& results,
         Json& report) {
  Json& notes = report["notes"];
  report[kMesaThreads] = mesa_threads;
  report["contexts"] = Json::array();
  for (GlBackend& backend : find_backends(options, mesa_threads, notes)) {
    report["contexts"].push_back({{"context", backend.context},
                                  {"renderer", backend.renderer},
                                  {"version", backend.version},
                                  {"is_software", backend.is_software}});
    start_strategies(backend, notes);
    measure_limits(results, backend);
    measure_quick(results, backend);
    if (options.is_full) {
      climb_points(results, backend);
      climb_triangles(results, backend);
    }
    backend.rasterizers.clear();
  }
}

void run_program(const std::vector<std::string>& arguments) {
  const std::string mesa_threads = prepare_mesa();
  const RunOptions options = parse_run_options("backend_benchmark", list_gl_contexts(), arguments);
  run_and_store("backend_benchmark", options, [&](Results& results, Json& report) {
    run(options, mesa_threads, results, report);
  });
}

}  // namespace

}  // namespace rangezip::benchmark

int main(int argc, char** argv) {
  using namespace rangezip::benchmark;
  return exit_code_of("backend_benchmark", [&] { run_program({argv + 1, argv + argc}); });
}
