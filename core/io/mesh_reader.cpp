#include "core/io/mesh_file.h"
#include "core/io/raw_geometry.h"
#include "core/io/read_opened.h"

namespace rangezip {

TriangleMesh read_mesh(const std::filesystem::path& path) {
  check_geometry_type(path);
  return read_opened_mesh(FileBytes(path));
}

TriangleMesh read_opened_mesh(const FileBytes& file) {
  RawGeometry geometry = read_geometry(file, PositionList::Precision::exact, std::nullopt, {});
  TriangleMesh mesh;
  mesh.triangles = split_polygons(geometry).triangles;
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
