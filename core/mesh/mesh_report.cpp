#include "core/mesh/mesh_report.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "core/base/disjoint_sets.h"
#include "core/base/error.h"
#include "core/mesh/edge_map.h"

namespace rangezip {

namespace {

constexpr std::size_t kBlock = 65536;  ///< faces or vertices between two looks at the stop token

/// Corner i of face f has number 3 f + i; its half-edge runs from it to the next corner.
std::uint32_t next_corner(std::uint32_t corner) {
  return corner % 3 == 2 ? corner - 2 : corner + 1;
}

bool has_repeated_corner(const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

bool has_no_area(const TriangleMesh& mesh, const Triangle& t) {
  const Vec3 area = area_vector(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
  return !(glm::dot(area, area) > 0.0);
}

/// The half-edges of all faces without a repeated corner, in order of their lower vertex, then
/// their higher one: those of one edge stand side by side.
class SortedHalfEdges {
 public:
  struct HalfEdge {
    std::uint32_t high = 0;    ///< the higher vertex
    std::uint32_t corner = 0;  ///< where it starts

    friend auto operator<=>(const HalfEdge&, const HalfEdge&) = default;
  };

  SortedHalfEdges(const TriangleMesh& mesh, const Progress& progress)
      : first_(mesh.positions.size() + 1, 0) {
    for_each(mesh, progress, [&](std::uint32_t low, HalfEdge) { ++first_[low + 1]; });
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    sorted_.resize(first_.back());
    std::vector<std::size_t> place(first_.begin(), first_.end() - 1);
    for_each(mesh, progress, [&](std::uint32_t low, HalfEdge h) { sorted_[place[low]++] = h; });
    for (std::size_t low = 0; low + 1 < first_.size(); ++low) {
      if (low % kBlock == 0) progress.check_stop();
      std::sort(begin_of(low), begin_of(low + 1));
    }
  }

  /// Calls edge(half_edges) for every edge.
  template <class F>
  void for_each_edge(const Progress& progress, const F& edge) const {
    for (std::size_t low = 0; low + 1 < first_.size(); ++low) {
      if (low % kBlock == 0) progress.check_stop();
      for (std::size_t i = first_[low]; i < first_[low + 1];) {
        std::size_t end = i + 1;
        while (end < first_[low + 1] && sorted_[end].high == sorted_[i].high)
          ++end;
        edge(std::span<const HalfEdge>(sorted_).subspan(i, end - i));
        i = end;
      }
    }
  }

 private:
  template <class F>
  static void for_each(const TriangleMesh& mesh, const Progress& progress, const F& visit) {
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
      if (f % kBlock == 0) progress.check_stop();
      const Triangle& t = mesh.triangles[f];
      if (has_repeated_corner(t)) continue;
      for (std::size_t i = 0; i < 3; ++i) {
        const auto [low, high] = std::minmax(t[i], t[(i + 1) % 3]);
        visit(low, HalfEdge{high, static_cast<std::uint32_t>(3 * f + i)});
      }
    }
  }
  std::vector<HalfEdge>::iterator begin_of(std::size_t low) {
    return sorted_.begin() + static_cast<std::ptrdiff_t>(first_[low]);
  }

  std::vector<std::size_t> first_;  ///< per lower vertex, where its half-edges begin
  std::vector<HalfEdge> sorted_;
};

using HalfEdge = SortedHalfEdges::HalfEdge;

std::uint32_t vertex_of(const TriangleMesh& mesh, std::uint32_t corner) {
  return mesh.triangles[corner / 3][corner % 3];
}

/// What hangs together, as far as the edges seen so far tell.
struct Pieces {
  explicit Pieces(const TriangleMesh& mesh)
      : fans_of(mesh.positions.size(), 0),
        components(mesh.triangles.size()),
        fans(3 * mesh.triangles.size()) {}

  std::vector<std::uint32_t> fans_of;   ///< fans of faces per vertex, at first one per corner
  DisjointSets components;              ///< of faces
  DisjointSets fans;                    ///< of corners
  std::vector<std::uint32_t> boundary;  ///< corners where an edge of one face starts
};

/// Enters the corners of the faces without a repeated one, and returns how many these are.
std::size_t count_faces(const TriangleMesh& mesh, std::span<std::uint32_t> fans_of,
                        MeshReport& report) {
  report.faces = mesh.triangles.size();
  std::size_t proper_faces = 0;
  for (const Triangle& t : mesh.triangles) {
    if (has_repeated_corner(t)) {
      ++report.degenerate_faces;
      continue;
    }
    if (has_no_area(mesh, t)) ++report.degenerate_faces;
    ++proper_faces;
    for (const std::uint32_t v : t)
      ++fans_of[v];
  }
  return proper_faces;
}

/// Joins two faces over their common edge, which starts at corner `first` of one and, turned or
/// not, at corner `second` of the other.
void join_over_edge(const TriangleMesh& mesh, std::uint32_t first, std::uint32_t second,
                    Pieces& pieces, MeshReport& report) {
  if (pieces.components.join(first / 3, second / 3)) --report.components;
  const std::uint32_t start = vertex_of(mesh, first);
  const bool same_way = vertex_of(mesh, second) == start;
  const std::uint32_t tail = same_way ? second : next_corner(second);
  const std::uint32_t head = same_way ? next_corner(second) : second;
  if (pieces.fans.join(first, tail)) --pieces.fans_of[start];
  if (pieces.fans.join(next_corner(first), head)) --pieces.fans_of[vertex_of(mesh, head)];
}

void count_edge(const TriangleMesh& mesh, std::span<const HalfEdge> sides, Pieces& pieces,
                MeshReport& report) {
  ++report.edges;
  const std::uint32_t first = sides.front().corner;
  if (sides.size() == 1) pieces.boundary.push_back(first);
  if (sides.size() > 2) ++report.nonmanifold_edges;
  if (sides.size() == 2 && vertex_of(mesh, sides[1].corner) == vertex_of(mesh, first)) {
    ++report.misoriented_edges;
  }
  for (const HalfEdge& side : sides.subspan(1))
    join_over_edge(mesh, first, side.corner, pieces, report);
}

std::size_t count_if_more(std::span<const std::uint32_t> counts, std::uint32_t than) {
  return static_cast<std::size_t>(std::count_if(
      counts.begin(), counts.end(), [than](std::uint32_t count) { return count > than; }));
}

/// Loops are counted as the connected pieces of the boundary, where two edges meet only inside
/// one fan of faces. @param fans corners joined over edges; used up
void count_loops(const TriangleMesh& mesh, std::span<const std::uint32_t> boundary,
                 DisjointSets& fans, MeshReport& report) {
  for (const std::uint32_t corner : boundary)
    fans.join(corner, next_corner(corner));
  std::vector<std::pair<std::uint32_t, double>> lengths;  // of one edge each, by loop
  lengths.reserve(boundary.size());
  for (const std::uint32_t corner : boundary) {
    const Vec3 edge = mesh.positions[vertex_of(mesh, next_corner(corner))] -
                      mesh.positions[vertex_of(mesh, corner)];
    lengths.emplace_back(fans.find(corner), glm::length(edge));
  }
  std::stable_sort(lengths.begin(), lengths.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (std::size_t i = 0; i < lengths.size();) {
    const std::uint32_t loop = lengths[i].first;
    double length = 0.0;
    for (; i < lengths.size() && lengths[i].first == loop; ++i)
      length += lengths[i].second;
    ++report.boundary_loops;
    report.longest_loop = std::max(report.longest_loop, length);
  }
}

std::string name_of_face(std::size_t face) {
  return "face " + std::to_string(face);
}

void check_elements(const TriangleMesh& mesh) {
  if (!mesh.sources.empty() && mesh.sources.size() != mesh.positions.size()) {
    throw TopologyError("check_mesh: " + std::to_string(mesh.sources.size()) + " sources for " +
                        std::to_string(mesh.positions.size()) + " positions");
  }
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3& p = mesh.positions[v];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      throw TopologyError("check_mesh: vertex " + std::to_string(v) + " is not finite");
    }
  }
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const Triangle& t = mesh.triangles[f];
    for (const std::uint32_t corner : t) {
      if (corner >= mesh.positions.size()) {
        throw TopologyError("check_mesh: " + name_of_face(f) + " has corner " +
                            std::to_string(corner) + ", but there are only " +
                            std::to_string(mesh.positions.size()) + " positions");
      }
    }
    if (has_repeated_corner(t)) {
      throw TopologyError("check_mesh: " + name_of_face(f) + " repeats a corner");
    }
  }
}

EdgeMap checked_edges(const TriangleMesh& mesh, const Progress& progress) {
  EdgeMap edges(3 * mesh.triangles.size());
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    if (f % kBlock == 0) progress.check_stop();
    const Triangle& t = mesh.triangles[f];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t from = t[i];
      const std::uint32_t to = t[(i + 1) % 3];
      if (!edges.insert(from, to, static_cast<std::uint32_t>(f))) {
        throw TopologyError("check_mesh: directed edge (" + std::to_string(from) + ", " +
                            std::to_string(to) + ") is in " + name_of_face(edges.find(from, to)) +
                            " and " + name_of_face(f));
      }
    }
  }
  return edges;
}

/// The corner after vertex v in a triangle.
std::uint32_t successor(const Triangle& t, std::uint32_t v) {
  return t[0] == v ? t[1] : t[1] == v ? t[2] : t[0];
}
std::uint32_t predecessor(const Triangle& t, std::uint32_t v) {
  return t[0] == v ? t[2] : t[1] == v ? t[0] : t[1];
}

/// Number of faces met by turning around v from `face`, first one way, then (if that way ends at
/// the boundary) the other.
std::size_t size_of_fan(const TriangleMesh& mesh, const EdgeMap& edges, std::uint32_t v,
                        std::uint32_t face) {
  std::size_t size = 1;
  std::uint32_t f = edges.find(v, predecessor(mesh.triangles[face], v));
  for (; f != EdgeMap::kNone && f != face; ++size) {
    f = edges.find(v, predecessor(mesh.triangles[f], v));
  }
  if (f == face) return size;
  f = edges.find(successor(mesh.triangles[face], v), v);
  for (; f != EdgeMap::kNone; ++size)
    f = edges.find(successor(mesh.triangles[f], v), v);
  return size;
}

void check_fans(const TriangleMesh& mesh, const EdgeMap& edges, const Progress& progress) {
  std::vector<std::uint32_t> faces(mesh.positions.size(), 0);
  std::vector<std::uint32_t> any_face(mesh.positions.size(), EdgeMap::kNone);
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    for (const std::uint32_t v : mesh.triangles[f]) {
      ++faces[v];
      any_face[v] = static_cast<std::uint32_t>(f);
    }
  }
  for (std::size_t v = 0; v < faces.size(); ++v) {
    if (v % kBlock == 0) progress.check_stop();
    if (faces[v] == 0) continue;
    if (size_of_fan(mesh, edges, static_cast<std::uint32_t>(v), any_face[v]) != faces[v]) {
      throw TopologyError("check_mesh: vertex " + std::to_string(v) +
                          " has more than one fan of faces");
    }
  }
}

}  // namespace

MeshReport report_mesh(const TriangleMesh& mesh, const Progress& progress) {
  MeshReport report;
  Pieces pieces(mesh);
  const std::size_t proper_faces = count_faces(mesh, pieces.fans_of, report);
  report.vertices = count_if_more(pieces.fans_of, 0);
  report.components = proper_faces;
  SortedHalfEdges(mesh, progress).for_each_edge(progress, [&](std::span<const HalfEdge> sides) {
    count_edge(mesh, sides, pieces, report);
  });
  report.boundary_edges = pieces.boundary.size();
  report.nonmanifold_vertices = count_if_more(pieces.fans_of, 1);
  report.euler = static_cast<std::ptrdiff_t>(report.vertices) -
                 static_cast<std::ptrdiff_t>(report.edges) +
                 static_cast<std::ptrdiff_t>(proper_faces);
  count_loops(mesh, pieces.boundary, pieces.fans, report);
  return report;
}

void check_mesh(const TriangleMesh& mesh, const Progress& progress) {
  check_elements(mesh);
  check_fans(mesh, checked_edges(mesh, progress), progress);
}

}  // namespace rangezip
