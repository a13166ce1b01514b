#include "benchmarks/report.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <fstream>
#include <stdexcept>
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

ReportOptions read_options(
    const std::vector<std::string>& arguments,
    const std::function<bool(const std::string& name, const std::string& value)>& set) {
  ReportOptions options;
  for (std::size_t i = 0; i < arguments.size(); i += 2) {
    const std::string& name = arguments[i];
    if (i + 1 == arguments.size()) throw std::runtime_error(name + " needs a value");
    const std::string& value = arguments[i + 1];
    if (name == "--json") {
      options.json = value;
    } else if (name == "--revision") {
      options.revision = value;
    } else if (!set(name, value)) {
      throw std::runtime_error("there is no option " + name);
    }
  }
  return options;
}

void write_report(const ReportOptions& options, const nlohmann::ordered_json& report) {
  if (options.json.empty()) return;
  std::ofstream file(options.json);
  file << report.dump(1) << '\n';
  if (!file.flush()) throw std::runtime_error("cannot write " + options.json);
}

int run_program(const std::string& name, int argc, char** argv,
                const std::function<int(const std::vector<std::string>& arguments)>& run) {
  try {
    return run({argv + 1, argv + argc});
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s: %s\n", name.c_str(), e.what());
    return 2;
  }
}

}  // namespace rangezip::benchmark
