#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/finish/components.h"
#include "core/finish/hole_filling.h"
#include "core/finish/loop_triangulation.h"

namespace rangezip {
namespace {

/// Cosine between a triangle and the face beside it: what bends more closes the end of a tube, or
/// folds back over an outline.
constexpr double kMinCosineBeside = 0.5;

bool is_short(const LoopShape& shape, const Triangle& t, double max_edge) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 side = shape.points[t[(i + 1) % 3]] - shape.points[t[i]];
    if (glm::dot(side, side) > max_edge * max_edge) return false;
  }
  return true;
}

/// Edge from t[i] to the next corner is one of the loop.
bool is_loop_edge(const LoopShape& shape, const Triangle& t, std::size_t i) {
  return (t[i] + 1) % shape.points.size() == t[(i + 1) % 3];
}

bool continues_surface(const LoopShape& shape, const Triangle& t) {
  const Vec3 area = area_vector(shape.points[t[0]], shape.points[t[1]], shape.points[t[2]]);
  const double length = glm::length(area);
  if (!(length > 0.0)) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!is_loop_edge(shape, t, i)) continue;
    if (glm::dot(area, shape.edge_normals[t[i]]) < kMinCosineBeside * length) return false;
  }
  return true;
}

/// Drops triangles that meet a point of the loop without being joined, around it, to a face of the
/// mesh. Dropping one may part others, so this goes on until none is left to drop.
void drop_unattached(const LoopShape& shape, std::vector<Triangle>& triangles) {
  for (;;) {
    const CornerTable table(triangles, shape.points.size());
    std::vector<std::uint8_t> dropped(triangles.size(), 0);
    bool any = false;
    for (std::uint32_t c = 0; c < table.corner_count(); ++c) {
      // Where a fan at this corner begins, turning counter-clockwise ...
      if (table.across(c) != CornerTable::kNone) continue;
      bool attached = is_loop_edge(shape, table.triangle(c / 3), c % 3);
      std::uint32_t last = CornerTable::previous(c);
      for (; table.across(last) != CornerTable::kNone;
           last = CornerTable::previous(table.across(last))) {
      }
      // ... and where it ends.
      attached = attached || is_loop_edge(shape, table.triangle(last / 3), last % 3);
      if (attached) continue;
      dropped[c / 3] = 1;
      any = true;
    }
    if (!any) return;
    remove_triangles(triangles, dropped);
  }
}

}  // namespace

std::vector<HoleFill> zip_loop(const std::vector<Vec3>& positions, const CornerTable& table,
                               const BoundaryLoop& loop, double max_edge,
                               const CloudEvidence& evidence, TriangulationMemo* memo) {
  const LoopShape shape = shape_of(loop, table, positions, evidence);
  std::vector<Triangle> triangles = triangulate_loop(shape, memo);
  std::erase_if(triangles, [&](const Triangle& t) {
    return !is_short(shape, t, max_edge) || !continues_surface(shape, t);
  });
  drop_unattached(shape, triangles);
  const std::vector<std::uint32_t> piece =
      components_of(CornerTable(triangles, shape.points.size()));
  const std::vector<std::uint32_t> vertices = vertices_of(loop, table);
  std::vector<HoleFill> fills;
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    if (piece[f] >= fills.size()) fills.resize(piece[f] + 1);
    const Triangle& t = triangles[f];
    fills[piece[f]].triangles.push_back({vertices[t[0]], vertices[t[1]], vertices[t[2]]});
  }
  return fills;
}

}  // namespace rangezip
