#include "core/mesh/halfedge.h"

#include <string>

#include "core/base/error.h"

namespace rangezip {

namespace {

/// OpenMesh reports a face that it cannot add on its error stream as well as by an invalid handle;
/// a library has no business on the streams of the program that calls it.
void silence_openmesh() {
  static const bool is_silent = [] {
    omerr().disable();
    return true;
  }();
  static_cast<void>(is_silent);
}

OpenMesh::VertexHandle vertex_handle(std::uint32_t index) {
  return OpenMesh::VertexHandle(static_cast<int>(index));
}

}  // namespace

HalfedgeMesh halfedge_from_mesh(const TriangleMesh& mesh) {
  silence_openmesh();
  HalfedgeMesh halfedges;
  const std::size_t faces = mesh.triangles.size();
  halfedges.reserve(mesh.positions.size(), faces * 3 / 2 + faces / 8, faces);
  for (const Vec3& position : mesh.positions)
    halfedges.add_vertex(position);
  for (std::size_t f = 0; f < faces; ++f) {
    const Triangle& corners = mesh.triangles[f];
    for (const std::uint32_t corner : corners) {
      if (corner >= mesh.positions.size()) {
        throw TopologyError("halfedge_from_mesh: face " + std::to_string(f) +
                            " must use existing vertices, got index " + std::to_string(corner));
      }
    }
    const bool has_three_corners =
        corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0];
    if (!has_three_corners || !halfedges
                                   .add_face(vertex_handle(corners[0]), vertex_handle(corners[1]),
                                             vertex_handle(corners[2]))
                                   .is_valid()) {
      throw TopologyError("halfedge_from_mesh: face " + std::to_string(f) +
                          " would make the mesh not oriented or not manifold");
    }
  }
  return halfedges;
}

TriangleMesh mesh_from_halfedge(const HalfedgeMesh& mesh,
                                const std::vector<VertexSource>& sources) {
  TriangleMesh result;
  result.positions.reserve(mesh.n_vertices());
  result.triangles.reserve(mesh.n_faces());
  for (const auto vertex : mesh.all_vertices()) {
    result.positions.push_back(mesh.point(vertex));
  }
  result.sources = sources;
  for (const auto face : mesh.faces()) {
    Triangle corners;
    std::size_t k = 0;
    for (const auto vertex : mesh.fv_range(face)) {
      corners[k++] = static_cast<std::uint32_t>(vertex.idx());
    }
    result.triangles.push_back(corners);
  }
  remove_unused_vertices(result);
  return result;
}

}  // namespace rangezip
