#include <array>
#include <filesystem>
#include <string>

#include <fmt/format.h>

#include "apps/rangezip/commands.h"
#include "core/io/file_bytes.h"
#include "core/io/input_with_mesh.h"
#include "core/io/session_file.h"
#include "core/mesh/mesh_report.h"
#include "core/mesh/self_intersection.h"

namespace rangezip::app {

namespace {

struct InfoOptions {
  std::vector<std::filesystem::path> files;
  bool check = false;
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
  print_nonzero(console, "repeated points", report.repeated_points);
  print_nonzero(console, "skipped polygons", report.nonfinite_polygons);
  print_nonzero(console, "degenerate polygons", report.degenerate_polygons);
  for (const std::string& note : report.notes)
    print_line(console, "note", note);
}

void print_topology(Console& console, const TriangleMesh& mesh, bool check,
                    const Progress& progress) {
  const MeshReport report = report_mesh(mesh, progress);
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
  if (check) {
    print_count(console, "self-intersections", self_intersections(mesh, progress).size());
  }
}

std::string_view name_of(const Command& command) {
  constexpr std::array<std::string_view, 9> kNames{"scan",         "erase",
                                                   "erase_places", "smooth",
                                                   "fill",         "drop_unsupported",
                                                   "finish",       "turn_to_scanners",
                                                   "undo"};
  static_assert(std::variant_size_v<Command> == kNames.size());
  return kNames.at(command.index());
}

void print_session(Console& console, const std::filesystem::path& path) {
  const SessionFile session = read_session(path);
  console.print(path.string());
  print_line(console, "format", fmt::format("session, version {}", kSessionFileVersion));
  for (const SessionInput& input : session.inputs) {
    print_line(console, "input", input.path.string());
  }
  for (const SessionInput& input : session.also_read) {
    print_line(console, "also read", input.path.string());
  }
  if (session.initial_mesh) print_line(console, "mesh", session.initial_mesh->path.string());
  if (session.points) print_count(console, "points", *session.points);
  if (session.triangles) print_count(console, "triangles", *session.triangles);
  // Runs of the same command on one line.
  for (std::size_t i = 0; i < session.commands.size();) {
    std::size_t end = i + 1;
    while (end < session.commands.size() &&
           session.commands[end].index() == session.commands[i].index()) {
      ++end;
    }
    print_line(console, "command", fmt::format("{} x {}", end - i, name_of(session.commands[i])));
    i = end;
  }
}

void print_mesh_or_cloud(Console& console, const std::filesystem::path& path, bool check,
                         const Progress& progress) {
  const InputWithMesh file = read_input_with_mesh(path, progress);
  for (const InputReport& report : file.input.reports)
    print_input(console, report);
  if (!file.mesh.empty()) print_topology(console, file.mesh, check, progress);
}

void print_info(const InfoOptions& options, const Context& context) {
  Console console(false, context.stop);
  Progress progress;
  progress.stop = context.stop;
  for (const std::filesystem::path& path : options.files) {
    if (file_type(path) == "json") {
      print_session(console, path);
    } else {
      print_mesh_or_cloud(console, path, options.check, progress);
    }
    progress.check_stop();
  }
}

}  // namespace

void add_info_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<InfoOptions>();
  CLI::App& command = *app.add_subcommand("info", "Says what is in a cloud, a mesh or a session");
  command.add_option("FILE", options->files, "Of any type that 'mesh' reads, or a session (.json)")
      ->required();
  command.add_flag("--check", options->check, "Count the pairs of faces that cross each other too");
  command.callback([options, &action] {
    action = [options](const Context& context) { print_info(*options, context); };
  });
}

}  // namespace rangezip::app
