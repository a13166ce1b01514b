#include "core/stitch/sheet_mesh.h"

namespace rangezip {

std::array<SheetMesh::VertexHandle, 3> SheetMesh::corners(FaceHandle f) const {
  const HalfedgeHandle e = mesh.halfedge_handle(f);
  return {mesh.from_vertex_handle(e), mesh.to_vertex_handle(e),
          mesh.to_vertex_handle(mesh.next_halfedge_handle(e))};
}

std::int64_t SheetMesh::area(FaceHandle f) const {
  const auto [a, b, c] = corners(f);
  for (const VertexHandle v : {a, b, c}) {
    if (depth(v) == ImagePlane::kBehindViewer) return 0;
  }
  return orientation(point(a), point(b), point(c));
}

SheetMesh cut_out(const TriangleMesh& mesh, const std::vector<std::uint8_t>& marked) {
  constexpr std::uint32_t kUnused = 0xffff'ffffU;
  SheetMesh sheet;
  TriangleMesh part;
  std::vector<std::uint32_t> local(mesh.positions.size(), kUnused);
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    if (marked[f] == 0) continue;
    Triangle face = mesh.triangles[f];
    for (std::uint32_t& v : face) {
      if (local[v] == kUnused) {
        local[v] = static_cast<std::uint32_t>(part.positions.size());
        part.positions.push_back(mesh.positions[v]);
        sheet.vertex_in_whole.push_back(v);
      }
      v = local[v];
    }
    part.triangles.push_back(face);
    sheet.face_in_whole.push_back(f);
  }
  sheet.mesh = halfedge_from_mesh(part);
  return sheet;
}

void set_image(SheetMesh& sheet, const ImagePlane& image) {
  sheet.points.clear();
  sheet.depths.clear();
  for (const std::uint32_t v : sheet.vertex_in_whole) {
    sheet.points.push_back(image.points[v]);
    sheet.depths.push_back(image.depths[v]);
  }
}

std::vector<Triangle> faces_in_whole(const SheetMesh& sheet) {
  std::vector<Triangle> faces;
  faces.reserve(sheet.mesh.n_faces());
  for (const auto face : sheet.mesh.faces()) {
    Triangle t;
    std::size_t k = 0;
    for (const auto v : sheet.corners(face))
      t[k++] = sheet.vertex_in_whole[static_cast<std::size_t>(v.idx())];
    faces.push_back(t);
  }
  return faces;
}

}  // namespace rangezip
