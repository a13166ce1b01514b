#include "core/mesh/handles.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/base/disjoint_sets.h"

namespace rangezip {
namespace {

/// Of the faces around a vertex: successors less predecessors, and the same of their squares,
/// modulo 2^64.
struct Turn {
  std::uint64_t sum = 0;
  std::uint64_t squares = 0;
};

void add(Turn& turn, std::uint64_t successor, std::uint64_t predecessor) {
  turn.sum += successor - predecessor;
  turn.squares += successor * successor - predecessor * predecessor;
}

std::vector<Turn> turns_of(const TriangleMesh& mesh) {
  std::vector<Turn> turns(mesh.positions.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    add(turns[a], b, c);
    add(turns[b], c, a);
    add(turns[c], a, b);
  }
  return turns;
}

/// Where the boundary leads to from a vertex; nothing if it is inside. With first successor a and
/// last predecessor b the turn is a - b and a^2 - b^2.
std::uint32_t next_on_boundary(const Turn& turn, std::uint32_t none) {
  const auto difference = static_cast<std::int64_t>(turn.sum);
  if (difference == 0) return none;
  const std::int64_t sum = static_cast<std::int64_t>(turn.squares) / difference;
  return static_cast<std::uint32_t>((sum + difference) / 2);
}

struct Boundary {
  std::size_t edges = 0;
  std::size_t loops = 0;
};

Boundary boundary_of(const TriangleMesh& mesh) {
  const auto none = static_cast<std::uint32_t>(mesh.positions.size());
  std::vector<std::uint32_t> next;
  next.reserve(none);
  for (const Turn& turn : turns_of(mesh))
    next.push_back(next_on_boundary(turn, none));
  Boundary boundary;
  for (std::uint32_t start = 0; start < none; ++start) {
    if (next[start] == none) continue;
    ++boundary.loops;
    for (std::uint32_t v = start; v < none && next[v] != none; ++boundary.edges) {
      const std::uint32_t after = next[v];
      next[v] = none;
      v = after;
    }
  }
  return boundary;
}

struct Pieces {
  std::size_t vertices = 0;  ///< used by a face
  std::size_t components = 0;
};

Pieces pieces_of(const TriangleMesh& mesh) {
  DisjointSets joined(mesh.positions.size());
  std::vector<std::uint8_t> is_used(mesh.positions.size(), 0);
  std::size_t joins = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    is_used[a] = is_used[b] = is_used[c] = 1;
    joins += (joined.join(a, b) ? 1U : 0U) + (joined.join(b, c) ? 1U : 0U);
  }
  const auto vertices =
      static_cast<std::size_t>(std::count(is_used.begin(), is_used.end(), std::uint8_t{1}));
  return {vertices, vertices - joins};
}

}  // namespace

std::size_t count_handles(const TriangleMesh& mesh) {
  const Boundary boundary = boundary_of(mesh);
  const Pieces pieces = pieces_of(mesh);
  const auto signed_of = [](std::size_t count) { return static_cast<std::ptrdiff_t>(count); };
  const std::ptrdiff_t edges = signed_of(3 * mesh.triangles.size() + boundary.edges) / 2;
  const std::ptrdiff_t euler =
      signed_of(pieces.vertices) - edges + signed_of(mesh.triangles.size());
  const std::ptrdiff_t twice = 2 * signed_of(pieces.components) - signed_of(boundary.loops) - euler;
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, twice / 2));
}

}  // namespace rangezip
