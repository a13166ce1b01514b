#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/finish/border_gaps.h"

namespace rangezip {

/// The gaps of the border (core/finish/border_gaps.h) of a mesh that changes from time to time.
/// Only border edges near faces that have changed since are looked at again: what is beyond the
/// others, and which faces are near, has stayed.
class GapMemo {
 public:
  /// @param cloud must outlive the memo
  GapMemo(const PointGrid& cloud, const BorderGapOptions& options)
      : cloud_(cloud), options_(options) {}

  /// What find_border_gaps() finds. Cost: a few passes over the mesh, and that of
  /// find_border_gaps() for the edges looked at.
  /// @param mesh manifold, oriented; its vertices have the numbers that they had, new ones follow
  /// @param faces of the mesh, with at least the reach
  [[nodiscard]] std::vector<BorderGap> find(const TriangleMesh& mesh, const CornerTable& table,
                                            const FaceGrid& faces);

  /// Border edges that the last find() looked at.
  [[nodiscard]] std::size_t looked_at() const noexcept { return looked_at_; }

 private:
  /// What is known of the border edge from a vertex to its head.
  struct Known {
    std::uint32_t head = CornerTable::kNone;  ///< nothing
    std::optional<BorderGap> gap;
  };

  const PointGrid& cloud_;
  BorderGapOptions options_;
  TriangleMesh before_;
  std::vector<Known> known_;  ///< by vertex: at most one border edge leaves it
  std::size_t looked_at_ = 0;
};

}  // namespace rangezip
