#include "core/finish/face_tree.h"

#include <cstddef>
#include <cstdint>

namespace rangezip {

void FaceTree::sort() const {
  faces_ = table_.triangles();
  std::vector<Box> boxes(faces_.size());
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    for (const std::uint32_t v : faces_[f])
      boxes[f].add(positions_[v]);
  }
  boxes_.emplace(boxes);
}

TriangleMesh FaceTree::faces_in(const Box& box) const {
  std::call_once(is_sorted_, [&] { sort(); });
  TriangleMesh found;
  for (const std::uint32_t f : boxes_->meeting(box)) {
    const auto first = static_cast<std::uint32_t>(found.positions.size());
    found.triangles.push_back({first, first + 1, first + 2});
    for (const std::uint32_t v : faces_[f])
      found.positions.push_back(positions_[v]);
  }
  return found;
}

}  // namespace rangezip
