#include "benchmarks/speed/measure.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <limits>
#include <memory>
#include <string>
#include <thread>

#include "benchmarks/report.h"
#include "core/base/parallel.h"

// The limit of reading must not be that of narrow instructions.
#if defined(__x86_64__)
#define RANGEZIP_WIDEST __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define RANGEZIP_WIDEST
#endif

namespace rangezip::benchmark {

namespace {

using Json = nlohmann::ordered_json;

double now(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

Seconds time_of(const Case& one) {
  Seconds seconds;
  run_with_threads(one.threads, [&] {
    const Seconds begin = seconds_since_start();
    one.work();
    seconds = seconds_since_start() - begin;
  });
  return seconds;
}

constexpr double kNever = std::numeric_limits<double>::infinity();

void take_less(Seconds& best, const Seconds& taken) {
  best = {std::min(best.cpu, taken.cpu), std::min(best.wall, taken.wall)};
}

void take_less(Parts& best, const Parts& taken) {
  for (const auto& [name, seconds] : taken)
    take_less(best.try_emplace(name, Seconds{kNever, kNever}).first->second, seconds);
}

/// Threads that have run out of work look for more for a while; that time is not the next case's.
void let_threads_fall_asleep() {
  std::this_thread::sleep_for(std::chrono::milliseconds(10));
}

RANGEZIP_WIDEST std::uint64_t sum_of_words(const unsigned char* bytes, std::size_t count) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes + i * sizeof(word), sizeof(word));
    sum += word;
  }
  return sum;
}

/// So that no compiler finds unused what nobody looks at.
template <class T>
void use(const T& value) {
  asm volatile("" : : "r"(value) : "memory");
}

void read(Bytes bytes) {
  use(sum_of_words(reinterpret_cast<const unsigned char*>(bytes.data()),
                   bytes.size() / sizeof(std::uint64_t)));
}

void copy(Bytes bytes, std::byte* to) {
  std::memcpy(to, bytes.data(), bytes.size());
  use(to);
}

/// Rates range from less than one million to thousands.
double to_thousandths(double value) {
  return std::round(1000.0 * value) / 1000.0;
}

/// "points  AVX3  random  size 1024  ..."
std::string text_of(const Json& name) {
  std::string text;
  for (const auto& [key, value] : name.items())
    text += (value.is_string() ? value.get<std::string>() : key + " " + value.dump()) + "  ";
  return text;
}

}  // namespace

Seconds seconds_since_start() {
  return {now(CLOCK_PROCESS_CPUTIME_ID), now(CLOCK_MONOTONIC)};
}

Seconds operator-(const Seconds& end, const Seconds& begin) noexcept {
  return {end.cpu - begin.cpu, end.wall - begin.wall};
}

std::size_t size_of(const std::vector<Bytes>& input) {
  std::size_t size = 0;
  for (const Bytes bytes : input)
    size += bytes.size();
  return size;
}

std::vector<Case> limits_of(const std::vector<Bytes>& input) {
  const std::size_t size = size_of(input);
  const auto target = std::make_shared<std::vector<std::byte>>(size);
  const auto read_all = [input] { std::for_each(input.begin(), input.end(), read); };
  const auto copy_all = [input, target] {
    std::byte* to = target->data();
    for (const Bytes bytes : input) {
      copy(bytes, to);
      to += bytes.size();
    }
  };
  const auto items = static_cast<double>(size);
  return {{.name = {{"what", "reading"}, {"bytes", size}}, .items = items, .work = read_all},
          {.name = {{"what", "memcpy"}, {"bytes", size}}, .items = items, .work = copy_all}};
}

void Results::measure(const std::vector<Case>& cases, const Effort& effort) {
  const bool has_threads =
      std::any_of(cases.begin(), cases.end(), [](const Case& one) { return one.threads > 1; });
  const double load_before = load_average();
  const double enough = effort.seconds_per_case * static_cast<double>(cases.size());
  const double begin = now(CLOCK_MONOTONIC);
  std::vector<Seconds> best(cases.size(), {kNever, kNever});
  std::vector<Parts> best_parts(cases.size());
  int rounds = 0;
  for (; rounds < effort.rounds || now(CLOCK_MONOTONIC) - begin < enough; ++rounds) {
    for (std::size_t i = 0; i < cases.size(); ++i) {
      for (int run = 0; run < effort.runs_per_turn; ++run) {
        if (has_threads) let_threads_fall_asleep();
        take_less(best[i], time_of(cases[i]));
        if (cases[i].parts) take_less(best_parts[i], cases[i].parts());
      }
    }
  }
  for (std::size_t i = 0; i < cases.size(); ++i) {
    add({.name = cases[i].name,
         .items = cases[i].items,
         .fragments = cases[i].fragments,
         .is_by_wall = cases[i].is_by_wall,
         .seconds = best[i],
         .parts = best_parts[i],
         .runs = rounds * effort.runs_per_turn,
         .load_before = load_before,
         .load_after = load_average()});
  }
}

double Results::rate_seconds(const Row& row) {
  return row.is_by_wall ? row.seconds.wall : row.seconds.cpu;
}

void Results::add(const Row& row) {
  std::printf("%-98s %9.1f M/s  %9.3f ms cpu  %9.3f ms wall\n", text_of(row.name).c_str(),
              row.items / rate_seconds(row) / 1e6, 1e3 * row.seconds.cpu, 1e3 * row.seconds.wall);
  std::fflush(stdout);
  const auto same = std::find_if(rows_.begin(), rows_.end(),
                                 [&](const Row& other) { return other.name == row.name; });
  if (same == rows_.end()) {
    rows_.push_back(row);
    return;
  }
  take_less(same->seconds, row.seconds);
  take_less(same->parts, row.parts);
  same->runs += row.runs;
  same->load_after = row.load_after;
}

const Results::Row* Results::find(const Json& name) const {
  const auto found =
      std::find_if(rows_.begin(), rows_.end(), [&](const Row& row) { return row.name == name; });
  return found == rows_.end() ? nullptr : &*found;
}

Json Results::json_of(const Row& row) {
  Json json = row.name;
  json["cpu_seconds"] = row.seconds.cpu;
  json["wall_seconds"] = row.seconds.wall;
  json["million_per_second"] = to_thousandths(row.items / rate_seconds(row) / 1e6);
  if (row.is_by_wall) json["rate_by"] = "wall";
  for (const auto& [name, seconds] : row.parts) {
    json["parts"][name] = {{"cpu_seconds", seconds.cpu}, {"wall_seconds", seconds.wall}};
  }
  if (row.fragments > 0.0) {
    json["fragments"] = row.fragments;
    json["pixels_per_second"] = std::round(row.fragments / rate_seconds(row));
  }
  json["runs"] = row.runs;
  json["load"] = {row.load_before, row.load_after};
  return json;
}

Json Results::rows() const {
  Json rows = Json::array();
  for (const Row& row : rows_) {
    Json json = json_of(row);
    if (row.name.contains("bytes")) {
      const Row* const limit = find({{"what", "reading"}, {"bytes", row.name["bytes"]}});
      if (limit != nullptr) json["of_read_limit"] = limit->seconds.cpu / row.seconds.cpu;
    }
    rows.push_back(std::move(json));
  }
  return rows;
}

}  // namespace rangezip::benchmark
