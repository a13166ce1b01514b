#pragma once

#include <filesystem>
#include <string_view>

#include "core/io/file_bytes.h"
#include "core/io/input_file.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// What read_input() and read_mesh() do with a file once it is open: for whoever wants both of it,
/// since a pipe can be opened only once.

/// The type of lists of Stanford range scans.
inline constexpr std::string_view kListOfScans = "conf";

/// True for lists of Stanford range scans, which are no geometry themselves.
[[nodiscard]] bool is_list_of_scans(const std::filesystem::path& path);

/// As read_input(). @pre check_geometry_type() knows the type of `file`
[[nodiscard]] InputFile read_opened_input(const FileBytes& file, const Progress& progress);

/// As read_mesh(). @pre check_geometry_type() knows the type of `file`
[[nodiscard]] TriangleMesh read_opened_mesh(const FileBytes& file, const Progress& progress);

}  // namespace rangezip
