#pragma once

#include <cstdint>
#include <vector>

#include "core/base/geometry.h"
#include "core/finish/corner_table.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// A change of a few faces that mends a triangle with a small angle. It keeps the topology.
struct AngleMend {
  std::vector<std::uint32_t> gone;            ///< faces that it replaces
  std::vector<Triangle> faces;                ///< by these
  std::uint32_t vertex = CornerTable::kNone;  ///< the one that moves, if any
  Vec3 place{0.0};                            ///< where to
  double gain =
      0.0;  ///< how much less all smallest angles together lack, as sines, of what is enough
};

struct AngleMendOptions {
  double max_turn = 0.8;        ///< cosine between a face before and after
  double max_border_way = 0.0;  ///< of a vertex of the border, model units
  double enough = 0.25;         ///< sine of an angle as good as larger ones: 14 degrees
};

/// What may be done about a face with a small angle, best first: angles count by what their
/// sine lacks of what is enough, and the sum over the faces that change gets less.
/// - an edge turns, or turns with the vertex across from it going onto it;
/// - an edge collapses, into one of its ends or halfway; at the border, also to where the border's
///   edges on both sides meet;
/// - a corner moves on the faces around it, or, at the border, outward or away from a neighbour;
/// - the face goes, if its longest edge is one of the border, the corner across from it going to
///   that edge; or if only one of its edges is none of the border.
/// Angles that are enough count as equally good: then those with the least change are first.
[[nodiscard]] std::vector<AngleMend> angle_mends(std::uint32_t face,
                                                 const std::vector<Vec3>& positions,
                                                 const CornerTable& table,
                                                 const AngleMendOptions& options);

}  // namespace rangezip
