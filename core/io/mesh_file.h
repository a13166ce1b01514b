#pragma once

#include <filesystem>

#include "core/mesh/triangle_mesh.h"

namespace rangezip {

struct MeshFileOptions {
  bool ascii = false;        ///< PLY and STL: text instead of binary
  bool with_sources = false; ///< PLY: source primitive and view of every vertex as properties
};

/// Writes PLY (positions as doubles), OBJ, OFF or STL by the extension of `path`. Written beside the
/// target and renamed, so a failure leaves no partial file and an input can be overwritten safely.
/// Text has the fewest digits that give back the same double.
/// @throws IoError for an unknown extension or if the file cannot be written in full.
void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh,
                const MeshFileOptions& options = {});

/// Reads a mesh with its connectivity, positions in double: PLY, OBJ, OFF, STL (corners at the same
/// place are joined), .gz of each. Polygons are split. Not checked for manifoldness.
/// @throws IoError naming file, place and rule; also if there is no face.
[[nodiscard]] TriangleMesh read_mesh(const std::filesystem::path& path);

}  // namespace rangezip
