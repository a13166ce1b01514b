#include "core/mesh/outgoing_edges.h"

#include <algorithm>
#include <cstddef>

namespace rangezip {

OutgoingEdges::OutgoingEdges(const TriangleMesh& mesh) : starts_(mesh.positions.size() + 1, 0) {
  for (const Triangle& face : mesh.triangles) {
    for (const std::uint32_t from : face)
      ++starts_[from + 1];
  }
  for (std::size_t v = 1; v < starts_.size(); ++v)
    starts_[v] += starts_[v - 1];
  edges_.resize(starts_.back());
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    const Triangle& face = mesh.triangles[f];
    for (std::size_t k = 0; k < 3; ++k)
      edges_[starts_[face[k]]++] = {face[(k + 1) % 3], f};
  }
  // Filling moved every start to the next one's place.
  std::copy_backward(starts_.begin(), starts_.end() - 1, starts_.end());
  starts_.front() = 0;
}

}  // namespace rangezip
