#include "apps/rangezip-compare/sample_command.h"

#include <array>
#include <charconv>
#include <string_view>
#include <vector>

#include "apps/rangezip/outputs.h"
#include "compare/mesh_distance.h"
#include "core/base/error.h"
#include "core/io/atomic_file.h"
#include "core/io/mesh_file.h"

namespace rangezip::compare {

namespace {

void write_number(AtomicFile& file, double number, char end) {
  constexpr std::size_t kLongestDouble = 24;  // "-2.2250738585072014e-308"
  std::array<char, kLongestDouble + 1> text{};
  char* last = std::to_chars(text.data(), text.data() + kLongestDouble, number).ptr;
  *last++ = end;
  file.write(std::string_view(text.data(), static_cast<std::size_t>(last - text.data())));
}

void write_points(const std::filesystem::path& path, const std::vector<Vec3>& points,
                  const Progress& progress) {
  constexpr std::size_t kBetweenChecks = 100'000;
  AtomicFile file(path);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i % kBetweenChecks == 0) progress.check_stop();
    write_number(file, points[i].x, ' ');
    write_number(file, points[i].y, ' ');
    write_number(file, points[i].z, '\n');
  }
  file.commit();
}

std::vector<Vec3> sample(const SampleCommand& command, const Progress& progress) {
  const TriangleMesh mesh = read_mesh(command.mesh, progress);
  try {
    return sample_surface(mesh, {.count = command.points, .seed = command.seed});
  } catch (const TopologyError& error) {
    throw IoError(command.mesh.string() + ": " + error.what());
  }
}

}  // namespace

void run_sample_command(const SampleCommand& command, const Progress& progress) {
  app::Outputs().add("-o", command.cloud, {"xyz", "txt", "asc"});
  const std::vector<Vec3> points = sample(command, progress);
  app::write_output([&] { write_points(command.cloud, points, progress); });
}

}  // namespace rangezip::compare
