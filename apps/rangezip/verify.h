#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "core/mesh/mesh_report.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip::app {

/// "1 component, 2 boundary loops, Euler number 0".
[[nodiscard]] std::string topology_text(const MeshReport& report);

/// What keeps a mesh from being a clean one: "2 non-manifold edges, 1 self-intersecting pair";
/// empty for a clean one.
[[nodiscard]] std::string faults_text(const MeshReport& report, std::size_t self_intersections);

/// An empty mesh is no result: no file is written for it.
/// @param advice what may give one
/// @throws NotVerified if there is no face
void require_faces(const TriangleMesh& mesh, const std::filesystem::path& output,
                   const std::string& advice);

/// Reads the mesh given with --into or by a session.
/// @throws IoError as read_mesh(); TopologyError that names the file if it is no clean one
[[nodiscard]] TriangleMesh read_given_mesh(const std::filesystem::path& path,
                                           const Progress& progress);

}  // namespace rangezip::app
