#include "core/finish/untangle.h"

#include <cstdint>
#include <utility>
#include <vector>

#include "core/finish/corner_table.h"
#include "core/mesh/self_intersection.h"

namespace rangezip {
namespace {

constexpr int kRounds = 6;
constexpr int kNarrowRounds = 2;  // without the neighbours
constexpr int kSteps = 2;         // of smoothing, a round

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// Flags the vertices of the faces that cross others, and of those around.
void mark_vertices(const CornerTable& table, const Pairs& pairs, bool with_neighbors,
                   std::vector<std::uint8_t>& marked) {
  const auto mark = [&](std::uint32_t face) {
    for (const std::uint32_t v : table.triangle(face)) {
      marked[v] = 1;
      if (with_neighbors) table.for_each_neighbor(v, [&](std::uint32_t w) { marked[w] = 1; });
    }
  };
  for (const auto& [i, j] : pairs) {
    mark(i);
    mark(j);
  }
}

/// Of these the inner ones.
std::vector<std::uint8_t> tangled_vertices(const CornerTable& table, const Pairs& pairs,
                                           bool with_neighbors) {
  std::vector<std::uint8_t> tangled(table.vertex_count(), 0);
  mark_vertices(table, pairs, with_neighbors, tangled);
  for (std::uint32_t v = 0; v < tangled.size(); ++v) {
    if (table.is_boundary(v)) tangled[v] = 0;
  }
  return tangled;
}

/// Every flagged vertex to the middle of its neighbours, all at once.
void smooth(std::vector<Vec3>& positions, const CornerTable& table,
            const std::vector<std::uint8_t>& flags) {
  std::vector<Vec3> moved = positions;
  for (std::uint32_t v = 0; v < flags.size(); ++v) {
    if (flags[v] == 0) continue;
    Vec3 sum{0.0};
    int count = 0;
    table.for_each_neighbor(v, [&](std::uint32_t w) {
      sum += positions[w];
      ++count;
    });
    moved[v] = sum / static_cast<double>(count);
  }
  positions = std::move(moved);
}

/// Faces with a flagged vertex, and those that crossed.
std::vector<std::uint32_t> changed_faces(const TriangleMesh& mesh,
                                         const std::vector<std::uint8_t>& flags,
                                         const Pairs& pairs) {
  std::vector<std::uint32_t> changed;
  for (const auto& [i, j] : pairs) {
    changed.push_back(i);
    changed.push_back(j);
  }
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    const Triangle& t = mesh.triangles[f];
    if (flags[t[0]] != 0 || flags[t[1]] != 0 || flags[t[2]] != 0) changed.push_back(f);
  }
  return changed;
}

}  // namespace

UntangleReport take_back_crossing(TriangleMesh& mesh, const std::vector<Vec3>& before,
                                  const Progress& progress) {
  Pairs pairs = self_intersections(mesh, progress);
  const std::size_t crossed = pairs.size();
  if (pairs.empty()) return {};
  const CornerTable table(mesh.triangles, mesh.positions.size());
  std::vector<std::uint8_t> taken_back(mesh.positions.size(), 0);
  for (int round = 0; round < kRounds && !pairs.empty(); ++round) {
    mark_vertices(table, pairs, round > 0, taken_back);
    for (std::size_t v = 0; v < taken_back.size(); ++v) {
      if (taken_back[v] != 0) mesh.positions[v] = before[v];
    }
    pairs = self_intersections(mesh, changed_faces(mesh, taken_back, pairs), {}, progress);
  }
  return {crossed, std::move(pairs)};
}

UntangleReport untangle(TriangleMesh& mesh, std::span<const std::uint32_t> changed,
                        const Progress& progress) {
  Pairs pairs = self_intersections(mesh, changed, {}, progress);
  if (pairs.empty()) return {};
  const CornerTable table(mesh.triangles, mesh.positions.size());
  const std::size_t crossed = pairs.size();
  for (int round = 0; round < kRounds && !pairs.empty(); ++round) {
    const std::vector<std::uint8_t> tangled =
        tangled_vertices(table, pairs, round >= kNarrowRounds);
    for (int step = 0; step < kSteps; ++step)
      smooth(mesh.positions, table, tangled);
    pairs = self_intersections(mesh, changed_faces(mesh, tangled, pairs), {}, progress);
  }
  return {crossed, std::move(pairs)};
}

}  // namespace rangezip
