// How fast the CPU rasterizer draws: items a second of processor time, the best of several runs.
//   raster_benchmark [quick|full] [--only WHAT]... [--json FILE] [--revision TEXT]
// quick: the scenes that have a target, 10 M points, about a minute; full: those and a ladder of
// sizes. WHAT: points, triangles, accumulate, threads (two against one), native (OSMesa beside the
// CPU rasterizer); default: all. TEXT: what the JSON says the program was built from.
// The limits stand in the same run: reading and copying the bytes of each scene.
// benchmarks/table.py makes tables of the JSON.

#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "benchmarks/report.h"
#include "benchmarks/speed/measure.h"
#include "benchmarks/speed/raster_cases.h"
#include "benchmarks/speed/raster_scenes.h"
#include "core/base/error.h"
#include "core/io/atomic_file.h"
#include "raster_cpu/cpu_rasterizer.h"
#ifdef RANGEZIP_WITH_GL
#include "benchmarks/speed/native_gl.h"
#endif

namespace rangezip::benchmark {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMillion = 1'000'000;
constexpr std::array kTrianglePixels{0.34, 1.4, 10.0, 400.0};

// What has a target: points, triangles, sums.

void measure_points(Results& results) {
  const Cloud random = make_cloud(10 * kMillion, Order::random);
  const Cloud scan = make_cloud(10 * kMillion, Order::scan);
  const Cloud curve = make_cloud(10 * kMillion, Order::curve);
  // One group: ratios are taken between these rows.
  std::vector<Case> cases = limits_of(bytes_of(random));
  for (const std::string& instructions : cpu_instructions())
    cases.push_back(points_case(random, {.instructions = instructions}));
  cases.push_back(points_case(scan, {}));
  cases.push_back(points_case(curve, {}));
  cases.push_back(points_case(random, {.is_central = true}));
  cases.push_back(points_case(random, {.size = 4096}));
  results.measure(cases, {.rounds = 5, .seconds_per_case = 0.5});

  cases = limits_of(bytes_of(random));
  for (const int point_size : {2, 3, 5})
    cases.push_back(points_case(random, {.point_size = point_size}));
  results.measure(cases, {.rounds = 3, .seconds_per_case = 0.5});
}

void measure_triangles(Results& results) {
  for (const double pixels : kTrianglePixels) {
    const FieldSetup setup = make_field_setup(pixels, kSize);
    std::vector<Case> cases = limits_of(bytes_of(setup.field));
    cases.push_back(triangles_case(setup, widest_instructions()));
    results.measure(cases, {.rounds = 5, .seconds_per_case = 0.5});
  }
}

void measure_accumulate(Results& results) {
  const Cloud random = make_cloud(10 * kMillion, Order::random);
  const Cloud curve = make_cloud(10 * kMillion, Order::curve);
  std::vector<Case> cases = limits_of(bytes_of(random));
  cases.push_back(accumulate_case(curve, widest_instructions()));
  cases.push_back(accumulate_case(random, widest_instructions()));
  results.measure(cases, {.rounds = 3, .seconds_per_case = 0.5});
}

/// The same work by one thread and by two, in turn.
void measure_thread_pair(Results& results, const Case& one) {
  Case alone = one, pair = one;
  alone.name = {{"what", "threads"}, {"scene", one.name["what"]}};
  for (const char* key : {"pixels", "order", "size", "count"})
    if (one.name.contains(key)) alone.name[key] = one.name[key];
  pair.name = alone.name;
  alone.name["threads"] = alone.threads = 1;
  pair.name["threads"] = pair.threads = 2;
  results.measure({alone, pair}, {.rounds = 20, .seconds_per_case = 0.0, .runs_per_turn = 1});
}

void measure_threads(Results& results, Json& notes) {
  if (std::thread::hardware_concurrency() < 2) {
    notes.push_back("threads: this machine has one core, so two threads are not measured");
    return;
  }
  const Cloud random = make_cloud(10 * kMillion, Order::random);
  const Cloud curve = make_cloud(10 * kMillion, Order::curve);
  const FieldSetup setup = make_field_setup(kTrianglePixels.front(), kSize);
  measure_thread_pair(results, points_case(random, {}));
  measure_thread_pair(results, triangles_case(setup, widest_instructions()));
  measure_thread_pair(results, accumulate_case(curve, widest_instructions()));
}

// Beside OSMesa.

#ifdef RANGEZIP_WITH_GL

/// The same item by OSMesa and by the CPU rasterizer, in turn.
void measure_native_pair(Results& results, NativeGl& gl, const View& view, const DrawItem& item,
                         const Json& scene) {
  gl.load(view, item);
  Case native{.name = scene, .items = static_cast<double>(primitive_count(item)), .work = [&] {
                gl.draw();
              }};
  Case ours{
      .name = scene, .items = native.items, .work = rendering(widest_instructions(), view, item)};
  native.name["by"] = "OSMesa";
  ours.name["by"] = "CpuRasterizer";
  results.measure({native, ours}, {.rounds = 3, .seconds_per_case = 0.5});
  if (gl.covered_pixels() == 0) throw BackendError("NativeGl: nothing was drawn");
}

void measure_native(Results& results, Json& notes) {
  std::optional<NativeGl> gl;
  try {
    gl.emplace();
  } catch (const BackendError& error) {  // OSMesa is looked for at run time
    notes.push_back(std::string("native: not measured: ") + error.what());
    return;
  }
  notes.push_back("native: OSMesa, " + gl->renderer() +
                  ", LP_NUM_THREADS=0 (draws on the calling thread); clear, draw and glFinish, "
                  "the buffers of vertices resident");
  const Cloud cloud = make_cloud(kMillion, Order::random);
  for (const int point_size : {1, 2, 3, 5}) {
    measure_native_pair(results, *gl, make_view(kSize, false), draw(cloud, point_size, false),
                        {{"what", "native"},
                         {"scene", "points"},
                         {"point_size", point_size},
                         {"size", kSize},
                         {"count", cloud.positions.size()}});
  }
  constexpr int kFieldSize = 512;  // as many triangles as points, about
  for (const double pixels : kTrianglePixels) {
    const Field field = make_field(pixels, kFieldSize);
    measure_native_pair(results, *gl, make_view(kFieldSize, false), draw(field),
                        {{"what", "native"},
                         {"scene", "triangles"},
                         {"pixels", pixels},
                         {"size", kFieldSize},
                         {"count", field.triangles.size()}});
  }
}

#else

void measure_native(Results&, Json& notes) {
  notes.push_back("native: built without OpenGL (RANGEZIP_WITH_GL=OFF), so OSMesa is not measured");
}

#endif

// The ladder of sizes.

constexpr Effort kLadderEffort{.rounds = 2, .seconds_per_case = 0.3};
constexpr std::array kOrders{Order::random, Order::scan, Order::curve};

/// Buffers, instructions and sizes of points, where one measurement is not long.
void climb_points(Results& results, const Cloud& cloud) {
  for (const int size : {512, kSize, 2048, 4096}) {
    std::vector<Case> cases = limits_of(bytes_of(cloud));
    for (const bool is_central : {false, true})
      cases.push_back(points_case(cloud, {.size = size, .is_central = is_central}));
    results.measure(cases, kLadderEffort);
  }
  std::vector<Case> cases = limits_of(bytes_of(cloud));
  for (const std::string& instructions : cpu_instructions())
    cases.push_back(points_case(cloud, {.instructions = instructions}));
  for (const int point_size : {2, 3, 5})
    cases.push_back(points_case(cloud, {.point_size = point_size}));
  results.measure(cases, kLadderEffort);
}

/// Points of one pixel by the widest instructions only: a run takes a second.
void climb_large_cloud(Results& results, const Cloud& cloud) {
  std::vector<Case> cases = limits_of(bytes_of(cloud));
  for (const int size : {512, kSize, 2048, 4096})
    cases.push_back(points_case(cloud, {.size = size}));
  results.measure(cases, kLadderEffort);
}

void climb_points(Results& results) {
  for (const Order order : kOrders) {
    for (const std::size_t count : {kMillion / 10, kMillion, 10 * kMillion})
      climb_points(results, make_cloud(count, order));
    climb_large_cloud(results, make_cloud(100 * kMillion, order));
  }
}

void climb_triangles(Results& results) {
  constexpr double kHuge = 10'000.0;
  std::vector<double> ladder(kTrianglePixels.begin(), kTrianglePixels.end());
  ladder.push_back(kHuge);
  for (const double pixels : ladder) {
    for (const int size : {512, kSize, 2048, 4096}) {
      const FieldSetup setup = make_field_setup(pixels, size);
      std::vector<Case> cases = limits_of(bytes_of(setup.field));
      if (size == kSize) {
        for (const std::string& instructions : cpu_instructions())
          cases.push_back(triangles_case(setup, instructions));
      } else {
        cases.push_back(triangles_case(setup, widest_instructions()));
      }
      results.measure(cases, kLadderEffort);
    }
  }
}

void climb_accumulate(Results& results) {
  for (const Order order : kOrders) {
    for (const std::size_t count : {kMillion / 10, kMillion, 10 * kMillion}) {
      const Cloud cloud = make_cloud(count, order);
      std::vector<Case> cases = limits_of(bytes_of(cloud));
      for (const std::string& instructions : cpu_instructions())
        cases.push_back(accumulate_case(cloud, instructions));
      results.measure(cases, kLadderEffort);
    }
  }
}

// The program.

constexpr std::array<const char*, 5> kParts{"points", "triangles", "accumulate", "threads",
                                            "native"};

struct Options {
  bool is_full = false;
  std::vector<std::string> only;
  std::string json;
  std::string revision = "unknown";

  [[nodiscard]] bool wants(const std::string& part) const {
    return only.empty() || std::find(only.begin(), only.end(), part) != only.end();
  }
};

[[noreturn]] void refuse(const std::string& reason) {
  throw InvalidArgument(reason +
                        "\nusage: raster_benchmark [quick|full] [--only WHAT]... [--json FILE] "
                        "[--revision TEXT]\nWHAT: points, triangles, accumulate, threads, native");
}

/// @throws InvalidArgument
Options parse(const std::vector<std::string>& arguments) {
  Options options;
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
      if (std::find(kParts.begin(), kParts.end(), options.only.back()) == kParts.end())
        refuse("--only does not know " + options.only.back());
    } else {
      refuse("unknown argument " + argument);
    }
  }
  return options;
}

Json describe(const Options& options) {
  Json report = describe_run("raster_benchmark", options.revision);
  report["instructions"] = cpu_instructions();
  report["extent"] = options.is_full ? "full" : "quick";
  report["only"] = options.only;
  report["load"] = {load_average()};
  return report;
}

void run(const Options& options, Results& results, Json& notes) {
  if (options.wants("points")) measure_points(results);
  if (options.wants("triangles")) measure_triangles(results);
  if (options.wants("accumulate")) measure_accumulate(results);
  if (options.wants("threads")) measure_threads(results, notes);
  if (options.wants("native")) measure_native(results, notes);
  if (!options.is_full) return;
  if (options.wants("points")) climb_points(results);
  if (options.wants("triangles")) climb_triangles(results);
  if (options.wants("accumulate")) climb_accumulate(results);
}

void run_program(const Options& options) {
  std::optional<AtomicFile> file;  // a place that cannot be written shows before the long run
  if (!options.json.empty()) file.emplace(options.json);
  Json report = describe(options);
  Json notes = Json::array();
  Results results;
  run(options, results, notes);
  for (const Json& note : notes)
    std::printf("%s\n", note.get<std::string>().c_str());
  report["load"].push_back(load_average());
  report["notes"] = notes;
  report["rows"] = results.rows();
  if (file) {
    file->write(report.dump(1) + "\n");
    file->commit();
  }
}

}  // namespace

}  // namespace rangezip::benchmark

int main(int argc, char** argv) {
  using namespace rangezip;
  try {
    benchmark::run_program(benchmark::parse({argv + 1, argv + argc}));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "raster_benchmark: %s\n", error.what());
    return 1;
  }
  return 0;
}
