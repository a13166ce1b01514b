// How fast clouds are read: points a second of CPU time, and the peak of memory.
//   io_benchmark [--binary POINTS] [--text POINTS] [--json FILE] [--revision TEXT]
// POINTS: in a binary file, default 10000000; in one of text, default 2000000. TEXT: what the JSON
// says the program was built from.
// Makes its files in the folder for temporary files and removes them.

#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "benchmarks/report.h"
#include "core/base/error.h"
#include "core/io/atomic_file.h"
#include "core/io/input_file.h"

namespace {

using Json = nlohmann::ordered_json;

/// Coordinates in [0, 1) by an additive recurrence: even, cheap, the same everywhere.
float coordinate(std::uint64_t i) {
  constexpr std::uint64_t kGolden = 0x9e37'79b9'7f4a'7c15U;
  constexpr unsigned kUnusedBits = 40;  // a float holds 24
  return static_cast<float>((i * kGolden) >> kUnusedBits) * 0x1p-24F;
}

std::string header(const char* format, const std::string& type, std::uint64_t points) {
  const std::string property = "property " + type + " ";
  return std::string("ply\nformat ") + format + " 1.0\nelement vertex " + std::to_string(points) +
         "\n" + property + "x\n" + property + "y\n" + property + "z\nend_header\n";
}

/// `Number` is float or double, `type` its name in PLY; all coordinates are moved by `offset`.
template <class Number>
void make_binary(const std::filesystem::path& path, const std::string& type, Number offset,
                 std::uint64_t points) {
  rangezip::AtomicFile file(path);
  file.write(header("binary_little_endian", type, points));
  for (std::uint64_t i = 0; i < 3 * points; ++i) {
    const Number value = offset + Number{coordinate(i)};
    const auto bytes = std::bit_cast<std::array<char, sizeof(Number)>>(value);
    file.write({bytes.data(), bytes.size()});
  }
  file.commit();
}

void make_text(const std::filesystem::path& path, const std::string& head, std::uint64_t points) {
  rangezip::AtomicFile file(path);
  file.write(head);
  std::array<char, 64> digits{};
  for (std::uint64_t i = 0; i < 3 * points; ++i) {
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), coordinate(i));
    *end.ptr = i % 3 == 2 ? '\n' : ' ';
    file.write({digits.data(), static_cast<std::size_t>(end.ptr + 1 - digits.data())});
  }
  file.commit();
}

long peak_mib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss / 1024;
}

double cpu_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// The file alone, and then the file as a scene: with bounds and checks.
Json measure(const std::filesystem::path& path) {
  const double begin = cpu_seconds();
  const std::size_t points = rangezip::read_input(path).reports.at(0).points;
  const double middle = cpu_seconds();
  static_cast<void>(rangezip::read_scene(std::array{path}));
  const double end = cpu_seconds();
  const double millions = static_cast<double>(points) / 1e6;
  const long file_mib = static_cast<long>(std::filesystem::file_size(path) >> 20U);
  const double file_rate = millions / (middle - begin), scene_rate = millions / (end - middle);
  std::printf(
      "%-12s %5.1f M points; M points/s of CPU: file %6.1f, scene %6.1f; peak %ld MiB, "
      "file %ld MiB\n",
      path.filename().c_str(), millions, file_rate, scene_rate, peak_mib(), file_mib);
  return {{"what", path.filename().string()},
          {"count", points},
          {"file_million_per_second", file_rate},
          {"scene_million_per_second", scene_rate},
          {"peak_mib", peak_mib()},
          {"file_mib", file_mib}};
}

/// A folder of its own that goes with this object.
struct TemporaryFolder {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("io_benchmark-" + std::to_string(::getpid()));

  TemporaryFolder() { std::filesystem::create_directory(path); }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
};

struct Options {
  std::uint64_t binary = 10'000'000;
  std::uint64_t text = 2'000'000;
  std::string json;
  std::string revision = "unknown";
};

[[noreturn]] void refuse(const std::string& reason) {
  throw rangezip::InvalidArgument(reason +
                                  "\nusage: io_benchmark [--binary POINTS] [--text POINTS] "
                                  "[--json FILE] [--revision TEXT]");
}

std::uint64_t count_of(const std::string& text) {
  std::uint64_t count = 0;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, count);
  if (read.ec != std::errc() || read.ptr != end || count == 0) refuse(text + " is no count");
  return count;
}

/// @throws InvalidArgument
Options parse(const std::vector<std::string>& arguments) {
  Options options;
  for (std::size_t i = 0; i < arguments.size(); i += 2) {
    const std::string& name = arguments[i];
    if (i + 1 == arguments.size()) refuse(name + " is unknown or needs a value");
    const std::string& value = arguments[i + 1];
    if (name == "--binary") {
      options.binary = count_of(value);
    } else if (name == "--text") {
      options.text = count_of(value);
    } else if (name == "--json") {
      options.json = value;
    } else if (name == "--revision") {
      options.revision = value;
    } else {
      refuse("unknown argument " + name);
    }
  }
  return options;
}

Json measure_all(const Options& options) {
  const TemporaryFolder folder;
  const auto file = [&](const char* name) { return folder.path / name; };
  make_text(file("cloud.xyz"), "", options.text);
  make_text(file("text.ply"), header("ascii", "float", options.text), options.text);
  make_binary(file("float.ply"), "float", 0.0F, options.binary);
  make_binary(file("double.ply"), "double", 0.0, options.binary);
  // As coordinates of a map grid: too far from 0 for floats, so stored about a nearer origin.
  make_binary(file("far.ply"), "double", 5.0e6, options.binary);
  Json rows = Json::array();
  for (const char* name : {"cloud.xyz", "text.ply", "float.ply", "double.ply", "far.ply"})
    rows.push_back(measure(file(name)));
  return rows;
}

void run_program(const Options& options) {
  std::optional<rangezip::AtomicFile> file;  // a place that cannot be written shows at once
  if (!options.json.empty()) file.emplace(options.json);
  Json report = rangezip::benchmark::describe_run("io_benchmark", options.revision);
  report["load"] = {rangezip::benchmark::load_average()};
  report["rows"] = measure_all(options);
  report["load"].push_back(rangezip::benchmark::load_average());
  if (file) {
    file->write(report.dump(1) + "\n");
    file->commit();
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run_program(parse({argv + 1, argv + argc}));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "io_benchmark: %s\n", error.what());
    return 1;
  }
  return 0;
}
