#include "core/finish/mark_around.h"

#include <cstddef>

#include "core/finish/box_tree.h"

namespace rangezip {

void mark_around(const TriangleMesh& mesh,
                 const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs,
                 const std::vector<Vec3>& places, std::vector<std::uint8_t>& marked) {
  std::vector<Box> boxes;
  boxes.reserve(pairs.size());
  for (const auto& [i, j] : pairs) {
    Box& box = boxes.emplace_back(box_of(mesh, mesh.triangles[i]));
    box.add(box_of(mesh, mesh.triangles[j]));
  }
  const BoxTree tree(boxes);
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (tree.meets({places[i], places[i]})) marked[i] = 1;
  }
}

}  // namespace rangezip
