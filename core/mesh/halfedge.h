#pragma once

#include <cstdint>

#include "core/mesh/triangle_mesh.h"

// OpenMesh takes glm's vectors as its points by this trait and the three functions that its
// kernel finds by argument-dependent lookup. All must be declared before its mesh headers.
#include <OpenMesh/Core/Utils/vector_traits.hh>

template <>
struct OpenMesh::vector_traits<rangezip::Vec3> {
  using vector_type = rangezip::Vec3;
  using value_type = double;
  static constexpr std::size_t size_ = 3;
  static std::size_t size() { return size_; }
};

namespace glm {
inline double norm(const dvec3& v) {
  return length(v);
}
inline double sqrnorm(const dvec3& v) {
  return dot(v, v);
}
inline void vectorize(dvec3& v, double value) {
  v = dvec3(value);
}
}  // namespace glm

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

namespace rangezip {

struct SurgeryTraits : OpenMesh::DefaultTraits {
  using Point = Vec3;
  using Normal = Vec3;
  VertexAttributes(OpenMesh::Attributes::Status);
  HalfedgeAttributes(OpenMesh::Attributes::PrevHalfedge | OpenMesh::Attributes::Status);
  EdgeAttributes(OpenMesh::Attributes::Status);
  FaceAttributes(OpenMesh::Attributes::Status);
};

/// A triangle mesh whose elements know their neighbours, for surgery (flips, splits, collapses).
/// This header is private to the sources of the library: it is not installed.
using HalfedgeMesh = OpenMesh::TriMesh_ArrayKernelT<SurgeryTraits>;

/// The same vertices and faces under the same indices.
/// @throws TopologyError if the mesh is not oriented and manifold, or an index is out of range.
/// Cost: O(faces), about 0.5 us each.
[[nodiscard]] HalfedgeMesh halfedge_from_mesh(const TriangleMesh& mesh);

/// Faces and used vertices that are not deleted, in the order of their indices, so that nothing
/// else than the index tells vertices of `mesh` from added ones.
/// @param sources one per vertex of `mesh`, or empty
[[nodiscard]] TriangleMesh mesh_from_halfedge(const HalfedgeMesh& mesh,
                                              const std::vector<VertexSource>& sources = {});

}  // namespace rangezip
