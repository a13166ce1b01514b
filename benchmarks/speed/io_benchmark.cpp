// How fast clouds are read: points a second of CPU time, and the peak of memory.
//   io_benchmark [binary points, default 10000000] [text points, default 2000000]
// Makes its files in the folder for temporary files and removes them.

#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <string>

#include "core/io/atomic_file.h"
#include "core/io/input_file.h"

namespace {

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
void measure(const std::filesystem::path& path) {
  const double begin = cpu_seconds();
  const std::size_t points = rangezip::read_input(path).reports.at(0).points;
  const double middle = cpu_seconds();
  static_cast<void>(rangezip::read_scene(std::array{path}));
  const double end = cpu_seconds();
  const double millions = static_cast<double>(points) / 1e6;
  std::printf(
      "%-12s %5.1f M points; M points/s of CPU: file %6.1f, scene %6.1f; peak %ld MiB, "
      "file %ld MiB\n",
      path.filename().c_str(), millions, millions / (middle - begin), millions / (end - middle),
      peak_mib(), static_cast<long>(std::filesystem::file_size(path) >> 20U));
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t binary = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 10'000'000;
  const std::uint64_t text = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 2'000'000;
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("io_benchmark-" + std::to_string(::getpid()));
  std::filesystem::create_directory(folder);
  make_text(folder / "cloud.xyz", "", text);
  make_text(folder / "text.ply", header("ascii", "float", text), text);
  make_binary(folder / "float.ply", "float", 0.0F, binary);
  make_binary(folder / "double.ply", "double", 0.0, binary);
  // As coordinates of a map grid: too far from 0 for floats, so stored about a nearer origin.
  make_binary(folder / "far.ply", "double", 5.0e6, binary);
  for (const char* name : {"cloud.xyz", "text.ply", "float.ply", "double.ply", "far.ply"})
    measure(folder / name);
  std::filesystem::remove_all(folder);
}
