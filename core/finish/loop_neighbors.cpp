#include "core/finish/loop_neighbors.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace rangezip {
namespace {

/// Loops run beside each other if at least this many vertices, and half of the shorter loop, do.
constexpr std::size_t kMinBeside = 4;

/// A vertex of a boundary, numbered over all loops.
struct BoundaryVertex {
  Vec3 position;
  std::uint32_t loop;
  std::uint32_t place;  ///< in its loop
};

/// All vertices, sorted along x: those within reach of one stand in a short run around it.
std::vector<BoundaryVertex> sorted_vertices(std::span<const BoundaryLoop> loops,
                                            const CornerTable& table,
                                            const std::vector<Vec3>& positions) {
  std::vector<BoundaryVertex> vertices;
  for (std::uint32_t l = 0; l < loops.size(); ++l) {
    const std::vector<std::uint32_t> of_loop = vertices_of(loops[l], table);
    for (std::uint32_t i = 0; i < of_loop.size(); ++i)
      vertices.push_back({positions[of_loop[i]], l, i});
  }
  std::sort(vertices.begin(), vertices.end(), [](const auto& p, const auto& q) {
    if (p.position.x != q.position.x) return p.position.x < q.position.x;
    return p.loop != q.loop ? p.loop < q.loop : p.place < q.place;
  });
  return vertices;
}

/// Keeps the nearer of two entries for the same pair of loops.
void offer(std::vector<LoopNeighbors>& nearest, const LoopNeighbors& entry) {
  const auto same = std::find_if(nearest.begin(), nearest.end(), [&](const LoopNeighbors& n) {
    return n.loop_a == entry.loop_a && n.loop_b == entry.loop_b;
  });
  if (same == nearest.end()) {
    nearest.push_back(entry);
  } else if (entry < *same) {
    *same = entry;
  }
}

}  // namespace

std::vector<LoopNeighbors> loop_neighbors(
    std::span<const BoundaryLoop> loops, const CornerTable& table,
    const std::vector<Vec3>& positions, double reach,
    const std::function<bool(std::uint32_t a, std::uint32_t b)>& are_wanted) {
  const std::vector<BoundaryVertex> vertices = sorted_vertices(loops, table, positions);
  std::vector<LoopNeighbors> found, nearest;
  const auto consider = [&](const BoundaryVertex& v, const BoundaryVertex& w) {
    if (v.loop == w.loop || !are_wanted(v.loop, w.loop)) return;
    const double distance = glm::length(v.position - w.position);
    if (distance > reach) return;
    const auto& [a, b] = v.loop < w.loop ? std::pair(v, w) : std::pair(w, v);
    offer(nearest, {a.loop, b.loop, distance, a.place, b.place});
  };
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const BoundaryVertex& v = vertices[i];
    nearest.clear();
    for (std::size_t k = i; k-- > 0 && v.position.x - vertices[k].position.x <= reach;)
      consider(v, vertices[k]);
    for (std::size_t k = i + 1;
         k < vertices.size() && vertices[k].position.x - v.position.x <= reach; ++k)
      consider(v, vertices[k]);
    found.insert(found.end(), nearest.begin(), nearest.end());
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<std::span<const LoopNeighbors>> loops_side_by_side(
    std::span<const LoopNeighbors> neighbors, std::span<const BoundaryLoop> loops) {
  std::vector<std::span<const LoopNeighbors>> pairs;
  for (std::size_t begin = 0, end = 0; begin < neighbors.size(); begin = end) {
    const LoopNeighbors& first = neighbors[begin];
    while (end < neighbors.size() && neighbors[end].loop_a == first.loop_a &&
           neighbors[end].loop_b == first.loop_b) {
      ++end;
    }
    const std::size_t shorter =
        std::min(loops[first.loop_a].corners.size(), loops[first.loop_b].corners.size());
    if (end - begin >= std::max(kMinBeside, shorter / 2))
      pairs.push_back(neighbors.subspan(begin, end - begin));
  }
  return pairs;
}

}  // namespace rangezip
