#pragma once

#include <vector>

#include "core/base/geometry.h"
#include "core/finish/crossing_guard.h"
#include "core/finish/face_part.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// The faces around some loops, with a guard over them and those that come.
class FacesAround {
 public:
  /// O(faces log loops) where few of the boxes around loops overlap. @param loops vertices of each
  /// @param pixel_size h, model units: faces up to 2 h from the box around a loop are watched
  FacesAround(const TriangleMesh& mesh, const std::vector<std::vector<std::uint32_t>>& loops,
              double pixel_size);

  /// Whether a face has an area, and crosses nothing; it may be asked from several threads.
  /// @param face with vertices of the loops, as in the mesh
  [[nodiscard]] bool can_take(const Triangle& face) const;

  /// Watches another face.
  void take(const Triangle& face);

 private:
  [[nodiscard]] Triangle local_of(Triangle face) const;

  FacePart part_;
  CrossingGuard guard_;
};

}  // namespace rangezip
