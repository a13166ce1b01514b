#include "core/finish/triangulation_memo.h"

#include <utility>

namespace rangezip {
namespace {

/// Equal for equal shapes only: the counts say where each part ends.
std::vector<double> key_of(const LoopShape& shape) {
  std::vector<double> key{static_cast<double>(shape.points.size()), shape.is_in_air ? 1.0 : 0.0,
                          shape.long_side, shape.longest_edge, shape.by_length ? 1.0 : 0.0};
  for (const Vec3& p : shape.points)
    key.insert(key.end(), {p.x, p.y, p.z});
  for (const Vec3& n : shape.edge_normals)
    key.insert(key.end(), {n.x, n.y, n.z});
  for (const auto& [i, k] : shape.forbidden)
    key.insert(key.end(), {static_cast<double>(i), static_cast<double>(k)});
  return key;
}

}  // namespace

std::vector<Triangle> TriangulationMemo::triangulate(const LoopShape& shape) {
  std::vector<double> key = key_of(shape);
  {
    const std::lock_guard lock(mutex_);
    const auto found = known_.find(key);
    if (found != known_.end()) return found->second;
  }
  std::vector<Triangle> triangles = triangulate_loop(shape);
  const std::lock_guard lock(mutex_);
  return known_.emplace(std::move(key), std::move(triangles)).first->second;
}

std::vector<Triangle> triangulate_loop(const LoopShape& shape, TriangulationMemo* memo) {
  return memo == nullptr ? triangulate_loop(shape) : memo->triangulate(shape);
}

}  // namespace rangezip
