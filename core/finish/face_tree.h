#pragma once

#include <mutex>
#include <optional>
#include <vector>

#include "core/finish/box_tree.h"
#include "core/finish/corner_table.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// The faces of a mesh by where they are, for looking at those in a box. They are sorted when the
/// first ones are asked for: few repairs ever ask.
class FaceTree {
 public:
  /// Refers to both, which are not to change.
  FaceTree(const std::vector<Vec3>& positions, const CornerTable& table)
      : positions_(positions), table_(table) {}

  /// The faces whose boxes have a point in common with this one, in their order; each has vertices
  /// of its own. May be called from several threads. O(faces of the mesh) once, then O(log n) for
  /// each that is found.
  /// @pre all positions are finite
  [[nodiscard]] TriangleMesh faces_in(const Box& box) const;

 private:
  void sort() const;

  const std::vector<Vec3>& positions_;
  const CornerTable& table_;
  mutable std::once_flag is_sorted_;
  mutable std::vector<Triangle> faces_;
  mutable std::optional<BoxTree> boxes_;  ///< of the faces
};

}  // namespace rangezip
