#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/base/geometry.h"
#include "core/finish/corner_table.h"

namespace rangezip {

/// What is known of the surface at a vertex.
struct VertexSides {
  /// The place on the surface, or on the feature that the vertex belongs to, next to a target;
  /// nothing where neither is known.
  std::function<std::optional<Vec3>(std::uint32_t vertex, const Vec3& target)> place_on;
  /// Whether the vertex may be collapsed, and its edges turned.
  std::function<bool(std::uint32_t vertex)> may_change;
  /// Whether a face at the vertex may look along `direction`, of any length: about as the surface,
  /// or one of the sides of the feature, does. True where nothing is known.
  std::function<bool(std::uint32_t vertex, const Vec3& direction)> may_face;
};

/// Whether the edge of a corner is one of the boundary, or its faces differ by 30 degrees or more.
[[nodiscard]] bool is_crease(const CornerTable& table, const std::vector<Vec3>& positions,
                             std::uint32_t corner);

/// Evens out the triangles along features: vertices on an edge slide along it, and those within
/// three edges of one within their side, each towards the middle of its neighbours, as long as the
/// smallest angle around it grows, or those of its faces do on average and none falls under 30
/// degrees; angles of faces that look the wrong way count as negative, so folds open. Within two
/// edges, those between faces of one side are turned where that makes the smallest angle grow, and
/// vertices with an angle under 24 degrees that stays go into a neighbour. Corners stay, and so
/// does what is farther away. What has been in vain is tried again where something changed around.
/// Linear in what is near features. @param is_feature per vertex: 1 on an edge, 2 at a corner
void relax_features(CornerTable& table, std::vector<Vec3>& positions,
                    const std::vector<std::uint8_t>& is_feature, const VertexSides& sides);

}  // namespace rangezip
