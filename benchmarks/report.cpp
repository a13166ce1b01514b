#include "benchmarks/report.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <thread>

namespace rangezip::benchmark {

namespace {

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

std::string compiler() {
#ifdef __clang__
  return __VERSION__;
#else
  return "GCC " __VERSION__;
#endif
}

std::string date() {
  const std::time_t now = std::time(nullptr);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M UTC", std::gmtime(&now));
  return text.data();
}

}  // namespace

double load_average() {
  double load = 0.0;
  return getloadavg(&load, 1) == 1 ? std::round(100.0 * load) / 100.0 : -1.0;
}

nlohmann::ordered_json describe_run(const std::string& program, const std::string& revision) {
  return {{"program", program},       {"date", date()},
          {"revision", revision},     {"compiler", compiler()},
          {"processor", processor()}, {"threads", std::thread::hardware_concurrency()}};
}

}  // namespace rangezip::benchmark
