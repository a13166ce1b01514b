#include "core/finish/settled_loops.h"

#include <algorithm>

namespace rangezip {

SettledLoops::SettledLoops(const TriangleMesh& mesh) {
  const CornerTable table(mesh.triangles, mesh.positions.size());
  for (std::uint32_t c = 0; c < table.corner_count(); ++c) {
    if (table.across(c) == CornerTable::kNone) edges_.emplace_back(table.vertex(c), table.head(c));
  }
  std::sort(edges_.begin(), edges_.end());
}

SettledLoops::SettledLoops(std::span<const BoundaryLoop> loops, const CornerTable& table) {
  for (const BoundaryLoop& loop : loops) {
    for (const std::uint32_t c : loop.corners)
      edges_.emplace_back(table.vertex(c), table.head(c));
  }
  std::sort(edges_.begin(), edges_.end());
}

bool SettledLoops::contain(const BoundaryLoop& loop, const CornerTable& table) const {
  return std::any_of(loop.corners.begin(), loop.corners.end(), [&](std::uint32_t c) {
    return std::binary_search(edges_.begin(), edges_.end(),
                              std::pair(table.vertex(c), table.head(c)));
  });
}

}  // namespace rangezip
