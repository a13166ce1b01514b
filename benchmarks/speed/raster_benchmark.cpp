// How fast the CPU rasterizer draws: items a second of processor time, the best of several runs.
//   raster_benchmark [quick|full] [--only WHAT]... [--json FILE] [--revision TEXT]
// quick: the scenes that have a target, 10 M points, about a minute; full: those and a ladder of
// sizes. WHAT: points, triangles, accumulate, threads (two against one); default: all. TEXT: what
// the JSON says the program was built from. The limits stand in the same run: reading and copying
// the bytes of each scene. benchmarks/table.py makes tables of the JSON.

#include <array>
#include <string>
#include <thread>
#include <vector>

#include "benchmarks/speed/benchmark_run.h"
#include "benchmarks/speed/measure.h"
#include "benchmarks/speed/raster_cases.h"
#include "benchmarks/speed/raster_scenes.h"
#include "raster_cpu/cpu_rasterizer.h"

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

void run(const RunOptions& options, Results& results, Json& report) {
  report["instructions"] = cpu_instructions();
  Json& notes = report["notes"];
  if (options.wants("points")) measure_points(results);
  if (options.wants("triangles")) measure_triangles(results);
  if (options.wants("accumulate")) measure_accumulate(results);
  if (options.wants("threads")) measure_threads(results, notes);
  if (!options.is_full) return;
  if (options.wants("points")) climb_points(results);
  if (options.wants("triangles")) climb_triangles(results);
  if (options.wants("accumulate")) climb_accumulate(results);
}

void run_program(const std::vector<std::string>& arguments) {
  const RunOptions options = parse_run_options(
      "raster_benchmark", {"points", "triangles", "accumulate", "threads"}, arguments);
  run_and_store("raster_benchmark", options,
                [&](Results& results, Json& report) { run(options, results, report); });
}

}  // namespace

}  // namespace rangezip::benchmark

int main(int argc, char** argv) {
  using namespace rangezip::benchmark;
  return exit_code_of("raster_benchmark", [&] { run_program({argv + 1, argv + argc}); });
}
