#include "core/io/mesh_file.h"
#include "core/io/raw_geometry.h"
#include "core/io/read_opened.h"

namespace rangezip {

TriangleMesh read_mesh(const std::filesystem::path& path, const Progress& progress) {
  check_geometry_type(path);
  return read_opened_mesh(FileBytes(path, FileBytes::Packing::unpack, progress), progress);
}

TriangleMesh read_opened_mesh(const FileBytes& file, const Progress& progress) {
  RawGeometry geometry =
      read_geometry(file, PositionList::Precision::exact, std::nullopt, progress);
  TriangleMesh mesh;
  mesh.triangles = split_polygons(geometry, progress).triangles;
  if (mesh.triangles.empty()) {
    file.fail("whole file: a mesh has at least one face with three distinct finite corners; " +
              std::to_string(geometry.polygons) + " faces were found");
  }
  const bool has_nonfinite = geometry.positions.nonfinite() != 0;
  mesh.positions = geometry.positions.take_exact();
  if (has_nonfinite) remove_unused_vertices(mesh);
  return mesh;
}

}  // namespace rangezip
