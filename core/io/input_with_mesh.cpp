#include "core/io/input_with_mesh.h"

#include "core/io/raw_geometry.h"
#include "core/io/read_opened.h"

namespace rangezip {

InputWithMesh read_input_with_mesh(const std::filesystem::path& path, const Progress& progress) {
  if (is_list_of_scans(path)) return {.input = read_input(path, progress)};
  check_geometry_type(path, kListOfScans);
  const FileBytes file(path, FileBytes::Packing::unpack, progress);
  InputWithMesh both{.input = read_opened_input(file, progress)};
  if (both.input.reports.front().triangles != 0) both.mesh = read_opened_mesh(file, progress);
  return both;
}

}  // namespace rangezip
