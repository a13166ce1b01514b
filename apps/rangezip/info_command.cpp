#include <filesystem>
#include <string>

#include <fmt/format.h>

#include "apps/rangezip/commands.h"
#include "core/base/parallel.h"
#include "core/io/input_file.h"
#include "core/io/mesh_file.h"
#include "core/mesh/mesh_report.h"

namespace rangezip::app {

namespace {

struct InfoOptions {
  std::vector<std::filesystem::path> files;
};

void print_line(Console& console, std::string_view name, const std::string& value) {
  console.print(fmt::format("  {:<22}{}", name, value));
}

void print_count(Console& console, std::string_view name, std::size_t count) {
  print_line(console, name, with_commas(count));
}

/// A count that is worth a line only where something is wrong.
void print_nonzero(Console& console, std::string_view name, std::size_t count) {
  if (count > 0) print_count(console, name, count);
}

std::string vector_text(const Vec3& v) {
  return fmt::format("{:.9g} {:.9g} {:.9g}", v.x, v.y, v.z);
}

void print_input(Console& console, const InputReport& report) {
  console.print(report.path);
  print_line(console, "format", report.format);
  print_count(console, "points", report.points);
  print_count(console, "triangles", report.triangles);
  if (report.polygons != report.triangles) print_count(console, "polygons", report.polygons);
  if (!report.bounds.is_empty()) {
    print_line(console, "lower corner", vector_text(report.bounds.lower));
    print_line(console, "upper corner", vector_text(report.bounds.upper));
  }
  print_nonzero(console, "skipped points", report.nonfinite_points);
  print_nonzero(console, "skipped polygons", report.nonfinite_polygons);
  print_nonzero(console, "degenerate polygons", report.degenerate_polygons);
  for (const std::string& note : report.notes)
    print_line(console, "note", note);
}

void print_topology(Console& console, const TriangleMesh& mesh) {
  const MeshReport report = report_mesh(mesh);
  print_count(console, "vertices in faces", report.vertices);
  print_count(console, "components", report.components);
  print_count(console, "boundary loops", report.boundary_loops);
  if (report.boundary_loops > 0) {
    print_line(console, "longest loop", fmt::format("{:.9g}", report.longest_loop));
  }
  print_line(console, "Euler number", std::to_string(report.euler));
  print_count(console, "non-manifold edges", report.nonmanifold_edges);
  print_count(console, "non-manifold vertices", report.nonmanifold_vertices);
  print_count(console, "misoriented edges", report.misoriented_edges);
  print_nonzero(console, "degenerate faces", report.degenerate_faces);
}

void print_info(const InfoOptions& options, const Context& context) {
  Console console(false, context.stop);
  Progress progress;
  progress.stop = context.stop;
  for (const std::filesystem::path& path : options.files) {
    const InputFile file = read_input(path, progress);
    for (const InputReport& report : file.reports)
      print_input(console, report);
    bool has_faces = false;
    for (const InputItem& item : file.items)
      has_faces = has_faces || item.soup != nullptr;
    if (has_faces) print_topology(console, read_mesh(path));
  }
}

}  // namespace

void add_info_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<InfoOptions>();
  CLI::App& command = *app.add_subcommand("info", "Says what is in a cloud, a mesh or a session");
  command.add_option("FILE", options->files, "Of any type that 'mesh' reads, or a session (.json)")
      ->required();
  command.callback([options, &action] {
    action = [options](const Context& context) { print_info(*options, context); };
  });
}

}  // namespace rangezip::app
