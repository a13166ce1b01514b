#include "core/finish/loop_neighbors.h"

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>

#include "core/base/cubes.h"

namespace rangezip {
namespace {

/// Loops run beside each other if at least this many vertices, and half of the shorter loop, do.
constexpr std::size_t kMinBeside = 4;
/// Runs of parts of them: neighbours, and how many places further on the next one may be.
constexpr std::size_t kMinRun = 16;
constexpr std::uint32_t kMaxStep = 4;

/// Of the reach: sides of the cubes in which vertices are looked up. The excess is for what rounds.
constexpr double kCube = 1.001;

/// A vertex of a boundary, numbered over all loops.
struct BoundaryVertex {
  Cube cube;
  Vec3 position;
  std::uint32_t loop;
  std::uint32_t place;  ///< in its loop
};

/// All vertices, sorted by their cubes: those within reach of one lie in its cube and those around.
std::vector<BoundaryVertex> sorted_vertices(std::span<const BoundaryLoop> loops,
                                            const CornerTable& table,
                                            const std::vector<Vec3>& positions, double reach) {
  std::vector<BoundaryVertex> vertices;
  for (std::uint32_t l = 0; l < loops.size(); ++l) {
    const std::vector<std::uint32_t> of_loop = vertices_of(loops[l], table);
    for (std::uint32_t i = 0; i < of_loop.size(); ++i) {
      const Vec3& position = positions[of_loop[i]];
      vertices.push_back({cube_of(position, kCube * reach), position, l, i});
    }
  }
  std::sort(vertices.begin(), vertices.end(), [](const auto& p, const auto& q) {
    return std::tie(p.cube, p.loop, p.place) < std::tie(q.cube, q.loop, q.place);
  });
  return vertices;
}

/// Calls visit(vertex) for those in a cube and in the ones that touch it, which are rows of three.
template <class Visit>
void for_each_around(const std::vector<BoundaryVertex>& vertices, const Cube& cube,
                     const Visit& visit) {
  for (int row = 0; row < 9; ++row) {
    const std::int64_t x = cube[0] + row % 3 - 1, y = cube[1] + row / 3 - 1;
    const Cube first{x, y, cube[2] - 1}, last{x, y, cube[2] + 1};
    auto v = std::lower_bound(vertices.begin(), vertices.end(), first,
                              [](const auto& vertex, const Cube& c) { return vertex.cube < c; });
    for (; v != vertices.end() && v->cube <= last; ++v)
      visit(*v);
  }
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

/// Calls visit(neighbors) for each pair of loops.
template <class Visit>
void for_each_pair(std::span<const LoopNeighbors> neighbors, const Visit& visit) {
  for (std::size_t begin = 0, end = 0; begin < neighbors.size(); begin = end) {
    const LoopNeighbors& first = neighbors[begin];
    while (end < neighbors.size() && neighbors[end].loop_a == first.loop_a &&
           neighbors[end].loop_b == first.loop_b) {
      ++end;
    }
    visit(neighbors.subspan(begin, end - begin));
  }
}

/// In the order of the first loop, which has n places, from behind a gap on; empty if there is
/// none.
std::vector<LoopNeighbors> sorted_from_gap(std::span<const LoopNeighbors> pairs, std::size_t n) {
  std::vector<LoopNeighbors> sorted(pairs.begin(), pairs.end());
  std::sort(sorted.begin(), sorted.end(), [](const LoopNeighbors& p, const LoopNeighbors& q) {
    return std::tie(p.place_a, p.place_b) < std::tie(q.place_a, q.place_b);
  });
  if (sorted.front().place_a + n - sorted.back().place_a > kMaxStep) return sorted;
  const auto gap = std::adjacent_find(sorted.begin(), sorted.end(),
                                      [](const LoopNeighbors& p, const LoopNeighbors& q) {
                                        return q.place_a - p.place_a > kMaxStep;
                                      });
  if (gap == sorted.end()) return {};
  std::rotate(sorted.begin(), gap + 1, sorted.end());
  return sorted;
}

}  // namespace

std::vector<LoopNeighbors> loop_neighbors(
    std::span<const BoundaryLoop> loops, const CornerTable& table,
    const std::vector<Vec3>& positions, double reach,
    const std::function<bool(std::uint32_t a, std::uint32_t b)>& are_wanted) {
  const std::vector<BoundaryVertex> vertices = sorted_vertices(loops, table, positions, reach);
  std::vector<LoopNeighbors> found, nearest;
  const auto consider = [&](const BoundaryVertex& v, const BoundaryVertex& w) {
    if (v.loop == w.loop) return;
    const double distance = glm::length(v.position - w.position);
    if (distance > reach || !are_wanted(v.loop, w.loop)) return;
    const auto& [a, b] = v.loop < w.loop ? std::pair(v, w) : std::pair(w, v);
    offer(nearest, {a.loop, b.loop, distance, a.place, b.place});
  };
  for (const BoundaryVertex& v : vertices) {
    nearest.clear();
    for_each_around(vertices, v.cube, [&](const BoundaryVertex& w) { consider(v, w); });
    found.insert(found.end(), nearest.begin(), nearest.end());
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<std::span<const LoopNeighbors>> loops_side_by_side(
    std::span<const LoopNeighbors> neighbors, std::span<const BoundaryLoop> loops) {
  std::vector<std::span<const LoopNeighbors>> found;
  for_each_pair(neighbors, [&](std::span<const LoopNeighbors> pairs) {
    const std::size_t shorter = std::min(loops[pairs.front().loop_a].corners.size(),
                                         loops[pairs.front().loop_b].corners.size());
    if (pairs.size() >= std::max(kMinBeside, shorter / 2)) found.push_back(pairs);
  });
  return found;
}

std::vector<std::vector<LoopNeighbors>> parts_side_by_side(std::span<const LoopNeighbors> neighbors,
                                                           std::span<const BoundaryLoop> loops) {
  std::vector<std::vector<LoopNeighbors>> runs;
  for_each_pair(neighbors, [&](std::span<const LoopNeighbors> pairs) {
    const std::size_t n = loops[pairs.front().loop_a].corners.size();
    std::vector<LoopNeighbors> run;
    const auto end_run = [&] {
      if (run.size() >= kMinRun) runs.push_back(run);
      run.clear();
    };
    for (const LoopNeighbors& pair : sorted_from_gap(pairs, n)) {
      if (!run.empty() && (pair.place_a + n - run.back().place_a) % n > kMaxStep) end_run();
      run.push_back(pair);
    }
    end_run();
  });
  return runs;
}

}  // namespace rangezip
