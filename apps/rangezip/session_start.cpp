#include "apps/rangezip/session_start.h"

#include <optional>
#include <string>

#include "apps/rangezip/verify.h"
#include "core/base/error.h"

namespace rangezip::app {

namespace {

Scene read_session_scene(const std::filesystem::path& path, const SessionFile& file,
                         const ReadScene& read_scene) {
  if (file.inputs.empty() && file.initial_mesh) return {};
  if (file.inputs.empty()) {
    throw IoError(path.string() + ": /inputs: must not be empty without initial_mesh");
  }
  std::vector<std::filesystem::path> paths;
  for (const SessionInput& input : file.inputs)
    paths.push_back(input.path);
  return read_scene(paths);
}

void check_count(const std::filesystem::path& path, const char* name,
                 std::optional<std::size_t> recorded, std::size_t count) {
  if (!recorded || *recorded == count) return;
  throw IoError(path.string() + ": /" + name + ": the inputs must have " +
                std::to_string(*recorded) + ", got " + std::to_string(count));
}

}  // namespace

SessionStart read_session_start(const std::filesystem::path& path, const SessionFile& file,
                                const ReadScene& read_scene, const Progress& progress) {
  check_session_inputs(file, progress);
  SessionStart start{.scene = read_session_scene(path, file, read_scene)};
  check_count(path, "points", file.points, start.scene.point_count());
  check_count(path, "triangles", file.triangles, start.scene.triangle_count());
  if (file.initial_mesh) {
    start.mesh = read_given_mesh(file.initial_mesh->path, progress);
  }
  return start;
}

}  // namespace rangezip::app
