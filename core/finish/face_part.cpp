#include "core/finish/face_part.h"

#include <cstddef>
#include <utility>

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

std::vector<std::uint8_t> vertices_within(const TriangleMesh& mesh,
                                          std::span<const std::uint32_t> faces, int edges) {
  std::vector<std::uint8_t> is_in(mesh.positions.size(), 0);
  for (const std::uint32_t f : faces) {
    for (const std::uint32_t v : mesh.triangles[f])
      is_in[v] = 1;
  }
  for (int edge = 0; edge < edges; ++edge) {
    std::vector<std::uint8_t> wider = is_in;
    for (const auto& [a, b, c] : mesh.triangles) {
      if ((is_in[a] | is_in[b] | is_in[c]) != 0) wider[a] = wider[b] = wider[c] = 1;
    }
    is_in = std::move(wider);
  }
  return is_in;
}

FacePart part_within(const TriangleMesh& mesh, std::span<const std::uint32_t> faces, int edges) {
  const std::vector<std::uint8_t> is_near = vertices_within(mesh, faces, edges);
  std::vector<std::uint8_t> is_in(mesh.triangles.size(), 0);
  for (std::size_t f = 0; f < is_in.size(); ++f) {
    const auto& [a, b, c] = mesh.triangles[f];
    is_in[f] = is_near[a] != 0 || is_near[b] != 0 || is_near[c] != 0 ? 1 : 0;
  }
  return face_part(mesh, is_in);
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
