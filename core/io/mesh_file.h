#pragma once

#include <filesystem>

#include "core/base/progress.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

struct MeshFileOptions {
  bool ascii = false;         ///< PLY and STL: text instead of binary
  bool with_sources = false;  ///< PLY: source primitive and view of every vertex, as properties
                              ///< `uint source_primitive` and `uint source_view`
};

/// Can write_mesh() write there? For a refusal before any work.
/// @throws IoError unless the extension is .ply, .obj, .off or .stl and the folder exists.
void check_mesh_path(const std::filesystem::path& path);

/// Writes PLY (positions as doubles), OBJ, OFF or STL by the extension of `path`. Written beside
/// the target and renamed, so a failure leaves no partial file and an input can be overwritten
/// safely. Text has the fewest digits that give back the same double; binary STL holds floats only.
/// @throws IoError for an unknown extension, if the file cannot be written in full, or if two
/// corners
///     of a face would become one in the floats of binary STL.
/// @throws Cancelled if `progress` says so, until all is written and only left to be flushed.
/// @throws InvalidArgument if `with_sources` is asked of a mesh without sources.
/// @pre every corner is the index of a position
void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh,
                const MeshFileOptions& options = {}, const Progress& progress = {});

/// Reads a mesh with its connectivity, positions in double: PLY, OBJ, OFF, STL (corners at the same
/// place are joined), .gz of each. Polygons are split. Not checked for manifoldness.
/// @throws IoError naming file, place and rule; also if there is no face.
/// @throws Cancelled if `progress` says so.
[[nodiscard]] TriangleMesh read_mesh(const std::filesystem::path& path,
                                     const Progress& progress = {});

}  // namespace rangezip
