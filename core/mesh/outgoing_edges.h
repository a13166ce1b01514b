#pragma once

#include <cstdint>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// The directed edges of a mesh that does not change, sorted by the vertex that they leave. Meshes
/// number neighbours close to each other, so the table is made and asked faster than an EdgeMap.
class OutgoingEdges {
 public:
  static constexpr std::uint32_t kNone = 0xffff'ffffU;

  /// O(faces), by a counting sort. @pre all corners are vertices of the mesh
  explicit OutgoingEdges(const TriangleMesh& mesh);

  /// The face of the edge, or kNone. Where an edge is in two faces, the first counts.
  /// @pre `from` is a vertex of the mesh
  [[nodiscard]] std::uint32_t find(std::uint32_t from, std::uint32_t to) const noexcept {
    for (std::uint32_t i = starts_[from]; i < starts_[from + 1]; ++i) {
      if (edges_[i].to == to) return edges_[i].face;
    }
    return kNone;
  }

  /// Calls visit(face) for each face with that corner. @pre it is a vertex of the mesh
  template <class Visit>
  void for_each_face_at(std::uint32_t vertex, const Visit& visit) const {
    for (std::uint32_t i = starts_[vertex]; i < starts_[vertex + 1]; ++i)
      visit(edges_[i].face);
  }

 private:
  struct Edge {
    std::uint32_t to = 0;
    std::uint32_t face = 0;
  };

  std::vector<std::uint32_t> starts_;  ///< of each vertex's edges
  std::vector<Edge> edges_;
};

}  // namespace rangezip
