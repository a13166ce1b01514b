#include "apps/rangezip-compare/sample_command.h"

#include <array>
#include <charconv>
#include <fstream>

#include "apps/rangezip/exit_code.h"
#include "compare/mesh_distance.h"
#include "core/io/mesh_file.h"

namespace rangezip::compare {

namespace {

void write_number(std::ofstream& file, double number, char end) {
  constexpr std::size_t kLongestDouble = 24;  // "-2.2250738585072014e-308"
  std::array<char, kLongestDouble + 1> text{};
  char* last = std::to_chars(text.data(), text.data() + kLongestDouble, number).ptr;
  *last++ = end;
  file.write(text.data(), last - text.data());
}

}  // namespace

void run_sample_command(const SampleCommand& command) {
  const std::vector<Vec3> points =
      sample_surface(read_mesh(command.mesh), {.count = command.points, .seed = command.seed});
  std::ofstream file(command.cloud, std::ios::binary);
  for (const Vec3& p : points) {
    write_number(file, p.x, ' ');
    write_number(file, p.y, ' ');
    write_number(file, p.z, '\n');
  }
  file.close();
  if (!file)
    throw app::OutputError(command.cloud.string() + ": the cloud cannot be written in full");
}

}  // namespace rangezip::compare
