#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "core/base/progress.h"
#include "core/io/session_file.h"
#include "core/mesh/triangle_mesh.h"
#include "core/scene/scene.h"

namespace rangezip::app {

/// What a session begins with.
struct SessionStart {
  Scene scene;        ///< empty for a session that only works on its mesh
  TriangleMesh mesh;  ///< empty without an initial mesh
};

using ReadScene = std::function<Scene(const std::vector<std::filesystem::path>&)>;

/// Reads the inputs of a session with `read_scene`, and its mesh.
/// @throws IoError naming file and place if an input has changed or is missing, there is neither an
///     input nor a mesh, or the scene has not the recorded numbers of points and triangles;
///     TopologyError if the mesh is no clean one; Cancelled if `progress` says so.
[[nodiscard]] SessionStart read_session_start(const std::filesystem::path& path,
                                              const SessionFile& file, const ReadScene& read_scene,
                                              const Progress& progress);

}  // namespace rangezip::app
