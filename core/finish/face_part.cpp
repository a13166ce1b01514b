#include "core/finish/face_part.h"

#include <cstddef>

namespace rangezip {

FacePart face_part(const TriangleMesh& mesh, const std::vector<std::uint8_t>& is_in) {
  FacePart part;
  part.index.assign(mesh.positions.size(), FacePart::kNone);
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    if (is_in[f] == 0) continue;
    Triangle t = mesh.triangles[f];
    for (std::uint32_t& v : t) {
      if (part.index[v] == FacePart::kNone) {
        part.index[v] = static_cast<std::uint32_t>(part.vertices.size());
        part.vertices.push_back(v);
        part.mesh.positions.push_back(mesh.positions[v]);
      }
      v = part.index[v];
    }
    part.faces.push_back(f);
    part.mesh.triangles.push_back(t);
  }
  return part;
}

void put_back(FacePart part, TriangleMesh& mesh) {
  std::vector<std::uint8_t> goes(mesh.triangles.size(), 0);
  for (const std::uint32_t f : part.faces)
    goes[f] = 1;
  remove_triangles(mesh.triangles, goes);
  for (std::size_t v = 0; v < part.mesh.positions.size(); ++v) {
    if (v < part.vertices.size()) {
      mesh.positions[part.vertices[v]] = part.mesh.positions[v];
      continue;
    }
    part.vertices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
    mesh.positions.push_back(part.mesh.positions[v]);
    if (!mesh.sources.empty()) mesh.sources.emplace_back();
  }
  for (const auto& [a, b, c] : part.mesh.triangles)
    mesh.triangles.push_back({part.vertices[a], part.vertices[b], part.vertices[c]});
}

}  // namespace rangezip
