#include "apps/rangezip/inputs.h"

#include <fmt/format.h>

#include <algorithm>

#include "apps/rangezip/exit_code.h"
#include "apps/rangezip/outputs.h"
#include "core/io/file_hash.h"

namespace rangezip::app {

namespace {

namespace fs = std::filesystem;

double total_bytes(const std::vector<fs::path>& paths) {
  double bytes = 0.0;
  for (const fs::path& path : paths) {
    std::error_code error;
    const auto size = fs::file_size(path, error);
    if (!error) bytes += static_cast<double>(size);
  }
  return bytes;
}

SessionInput with_hash(const fs::path& path, const Progress& progress) {
  return {.path = path, .hash = hash_file(path, progress)};
}

}  // namespace

SceneInput read_inputs(const std::vector<fs::path>& paths, Console& console) {
  const Progress progress = console.start_task("reading", total_bytes(paths), "bytes");
  SceneInput input = read_scene(paths, progress);
  console.end_task();
  return input;
}

void require_rereadable(const std::vector<fs::path>& paths,
                        const std::optional<fs::path>& session) {
  if (session) write_output([&] { check_session_paths(*session, paths); });
  for (const fs::path& path : paths) {
    std::error_code error;
    if (!fs::is_other(path, error)) continue;
    throw UsageError(path.string() +
                     ": a pipe or device cannot be read again, which a session needs to be "
                     "replayed; store its content in a file");
  }
}

std::string amount_text(const Scene& scene) {
  std::string text;
  if (scene.point_count() > 0) text = with_commas(scene.point_count()) + " points";
  if (scene.triangle_count() > 0) {
    text += (text.empty() ? "" : ", ") + with_commas(scene.triangle_count()) + " triangles";
  }
  return text;
}

std::string skipped_text(std::span<const InputReport> reports) {
  std::size_t nonfinite = 0, repeated = 0, polygons = 0;
  for (const InputReport& report : reports) {
    nonfinite += report.nonfinite_points;
    repeated += report.repeated_points;
    polygons += report.nonfinite_polygons + report.degenerate_polygons;
  }
  std::vector<std::string> parts;
  if (nonfinite > 0) parts.push_back("points not finite: " + with_commas(nonfinite));
  if (repeated > 0) parts.push_back("points repeated in one place: " + with_commas(repeated));
  if (polygons > 0) parts.push_back("polygons without three corners: " + with_commas(polygons));
  return fmt::format("{}", fmt::join(parts, ", "));
}

Workload workload_of(const Scene& scene) {
  if (scene.point_count() > 0) return {static_cast<double>(scene.point_count()), "points"};
  return {static_cast<double>(scene.triangle_count()), "triangles"};
}

std::vector<fs::path> files_of(const SceneInput& input) {
  std::vector<fs::path> files;
  for (const InputReport& report : input.reports)
    files.emplace_back(report.path);
  return files;
}

SessionFile record_session(const std::vector<fs::path>& paths, const SceneInput& input,
                           const std::optional<fs::path>& initial_mesh,
                           std::vector<Command> commands, const Progress& progress) {
  SessionFile session;
  for (const fs::path& path : paths)
    session.inputs.push_back(with_hash(path, progress));
  for (const fs::path& path : files_of(input)) {
    if (std::find(paths.begin(), paths.end(), path) == paths.end())
      session.also_read.push_back(with_hash(path, progress));
  }
  if (initial_mesh) session.initial_mesh = with_hash(*initial_mesh, progress);
  session.points = input.scene.point_count();
  session.triangles = input.scene.triangle_count();
  session.commands = std::move(commands);
  return session;
}

}  // namespace rangezip::app
