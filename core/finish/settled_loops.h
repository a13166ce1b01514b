#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/finish/boundary_loops.h"
#include "core/finish/corner_table.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// The border of a mesh of which it has been decided that it stays, for later repairs to leave it
/// alone: to choose again, on triangles that have changed since, would close other holes each time.
class SettledLoops {
 public:
  /// Of a mesh without border.
  SettledLoops() = default;

  /// All loops of a mesh. O(n log n) in its border edges.
  explicit SettledLoops(const TriangleMesh& mesh);

  /// Some of them.
  SettledLoops(std::span<const BoundaryLoop> loops, const CornerTable& table);

  /// Whether a loop runs along that border, if only in part: a cut may have bitten into it.
  /// @param table of the mesh, whose vertices have kept their numbers
  [[nodiscard]] bool contain(const BoundaryLoop& loop, const CornerTable& table) const;

 private:
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges_;  // in the direction of the faces
};

}  // namespace rangezip
