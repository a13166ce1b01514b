#pragma once

#include <filesystem>

#include "core/base/progress.h"
#include "core/io/input_file.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// One file both as a scene sees it and as a mesh.
struct InputWithMesh {
  InputFile input;    ///< as read_input()
  TriangleMesh mesh;  ///< as read_mesh(); empty if the file has no face, or is a list of scans
};

/// Opens and unpacks the file once, so that it may be a pipe.
/// @throws IoError as read_input().
/// @throws Cancelled if `progress` says so.
[[nodiscard]] InputWithMesh read_input_with_mesh(const std::filesystem::path& path,
                                                 const Progress& progress = {});

}  // namespace rangezip
