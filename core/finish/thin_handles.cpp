#include "core/finish/thin_handles.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <queue>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "core/base/parallel.h"
#include "core/base/spread.h"
#include "core/finish/boundary_loops.h"
#include "core/finish/components.h"
#include "core/finish/corner_table.h"
#include "core/finish/loop_disc.h"
#include "core/finish/unsupported_faces.h"

namespace rangezip {
namespace {

constexpr std::uint32_t kNone = CornerTable::kNone;

/// A well mixed word for each number: sums of different ones never cancel.
std::uint64_t word_of(std::uint64_t number) {
  return scrambled_bits(number * 0x9e37'79b9'7f4a'7c15U);
}

/// Calls visit(neighbour, half-edge between the two) for the edges at a vertex: for an inner one
/// twice, with each of its half-edges.
template <class Visit>
void for_each_edge_at(const CornerTable& table, std::uint32_t vertex, Visit visit) {
  table.for_each_corner(vertex, [&](std::uint32_t c) {
    visit(table.head(c), c);
    visit(table.apex(c), CornerTable::previous(c));
  });
}

/// A word for each edge, such that those along a closed path add up (by exclusive or) to 0 if and
/// only if the path parts the surface whose boundary loops are filled: 0 around every face, every
/// hole, and along the edges of a tree, so that the others follow from those few that close the
/// handles [Busaryev et al. 2012].
class EdgeWords {
 public:
  explicit EdgeWords(const CornerTable& table) : table_(table) {
    number_faces_and_holes();
    grow_vertex_tree();
    grow_face_tree();
    deduce_words();
  }

  [[nodiscard]] std::uint64_t operator[](std::uint32_t corner) const {
    return words_[edge_name(corner)];
  }

 private:
  /// The one of the two half-edges that stands for the edge.
  [[nodiscard]] std::uint32_t edge_name(std::uint32_t corner) const {
    return std::min(corner, table_.across(corner));
  }

  /// Holes are numbered after the faces.
  void number_faces_and_holes() {
    const auto faces = static_cast<std::uint32_t>(table_.face_count());
    beyond_.resize(table_.corner_count());
    for (std::uint32_t c = 0; c < table_.corner_count(); ++c) {
      beyond_[c] = table_.across(c) == kNone ? kNone : table_.across(c) / 3;
    }
    holes_ = boundary_loops(table_);
    for (std::uint32_t l = 0; l < holes_.size(); ++l) {
      for (const std::uint32_t c : holes_[l].corners)
        beyond_[c] = faces + l;
    }
  }

  void grow_vertex_tree() {
    is_in_tree_.assign(table_.corner_count(), 0);
    std::vector<std::uint8_t> is_reached(table_.vertex_count(), 0);
    std::vector<std::uint32_t> queue;
    for (std::uint32_t root = 0; root < table_.vertex_count(); ++root) {
      if (is_reached[root] != 0 || table_.corner_of(root) == kNone) continue;
      is_reached[root] = 1;
      queue.assign(1, root);
      for (std::size_t i = 0; i < queue.size(); ++i) {
        for_each_edge_at(table_, queue[i], [&](std::uint32_t vertex, std::uint32_t corner) {
          if (is_reached[vertex] != 0) return;
          is_reached[vertex] = 1;
          is_in_tree_[edge_name(corner)] = 1;
          queue.push_back(vertex);
        });
      }
    }
  }

  /// Calls visit(half-edge, what lies beyond) for each edge around a face or hole.
  template <class Visit>
  void for_each_edge_of(std::uint32_t node, Visit visit) const {
    const auto faces = static_cast<std::uint32_t>(table_.face_count());
    if (node < faces) {
      for (std::uint32_t c = 3 * node; c < 3 * node + 3; ++c)
        visit(c, beyond_[c]);
    } else {
      for (const std::uint32_t c : holes_[node - faces].corners)
        visit(c, c / 3);
    }
  }

  /// Over the edges that the other tree has not.
  void grow_face_tree() {
    const std::size_t count = table_.face_count() + holes_.size();
    edge_to_parent_.assign(count, kNone);
    parent_.assign(count, kNone);
    for (std::uint32_t root = 0; root < count; ++root) {
      if (parent_[root] != kNone) continue;
      parent_[root] = root;
      const std::size_t begin = order_.size();
      order_.push_back(root);
      for (std::size_t i = begin; i < order_.size(); ++i) {
        for_each_edge_of(order_[i], [&](std::uint32_t c, std::uint32_t next) {
          if (is_in_tree_[edge_name(c)] != 0 || parent_[next] != kNone) return;
          parent_[next] = order_[i];
          edge_to_parent_[next] = edge_name(c);
          order_.push_back(next);
        });
      }
    }
  }

  void deduce_words() {
    words_.assign(table_.corner_count(), 0);
    std::vector<std::uint64_t> sums(parent_.size(), 0);  // around each face and hole, so far
    for (std::uint32_t c = 0; c < table_.corner_count(); ++c) {
      if (edge_name(c) != c || is_in_tree_[c] != 0) continue;
      const std::uint32_t one = c / 3, other = beyond_[c];
      if (edge_to_parent_[one] == c || edge_to_parent_[other] == c) continue;
      words_[c] = word_of(c);
      sums[one] ^= words_[c];
      sums[other] ^= words_[c];
    }
    for (std::size_t i = order_.size(); i-- > 0;) {
      const std::uint32_t node = order_[i];
      if (edge_to_parent_[node] == kNone) continue;
      words_[edge_to_parent_[node]] = sums[node];
      sums[parent_[node]] ^= sums[node];
    }
  }

  const CornerTable& table_;
  std::vector<BoundaryLoop> holes_;
  std::vector<std::uint32_t> beyond_;          ///< face or hole across each half-edge
  std::vector<std::uint8_t> is_in_tree_;       ///< by edge name
  std::vector<std::uint32_t> parent_;          ///< of each face and hole; a root's is itself
  std::vector<std::uint32_t> edge_to_parent_;  ///< its name
  std::vector<std::uint32_t> order_;           ///< parents before children
  std::vector<std::uint64_t> words_;           ///< by edge name
};

/// A closed path along edges.
struct Cycle {
  double length = 0.0;
  std::uint64_t word = 0;               ///< the sum along it
  std::vector<std::uint32_t> vertices;  ///< in order

  friend bool operator<(const Cycle& a, const Cycle& b) {
    return std::tie(a.length, a.vertices) < std::tie(b.length, b.vertices);
  }
};

/// Looks for closed paths through one vertex.
class LocalSearch {
 public:
  /// @param lengths of half-edges
  LocalSearch(const CornerTable& table, const EdgeWords& words, const std::vector<double>& lengths)
      : table_(table), words_(words), lengths_(lengths) {}

  /// The shortest one that does not part the surface; longer than `max_length`, and without
  /// vertices, if there is none up to that.
  [[nodiscard]] Cycle shortest_through(std::uint32_t root, double max_length) const {
    const Ways ways = ways_from(root, 0.5 * max_length);
    Cycle best{.length = 2.0 * max_length};
    std::pair<std::uint32_t, std::uint32_t> closing{kNone, kNone};
    for (const auto& [a, way_a] : ways) {
      for_each_edge_at(table_, a,
                       [&, from = a, &way = way_a](std::uint32_t b, std::uint32_t corner) {
                         const auto other = ways.find(b);
                         if (other == ways.end()) return;
                         const std::uint64_t word = way.word ^ other->second.word ^ words_[corner];
                         if (word == 0) return;
                         const double length = way.length + other->second.length + lengths_[corner];
                         if (length > max_length || length >= best.length) return;
                         best.length = length;
                         best.word = word;
                         closing = {from, b};
                       });
    }
    if (closing.first != kNone) best.vertices = path(ways, closing.first, closing.second);
    return best;
  }

 private:
  /// The shortest way from the root to a vertex.
  struct Way {
    double length = 0.0;
    std::uint32_t from = kNone;
    std::uint64_t word = 0;
  };
  using Ways = std::map<std::uint32_t, Way>;  ///< by vertex; in order, which decides ties

  [[nodiscard]] Ways ways_from(std::uint32_t root, double max_length) const {
    using Entry = std::pair<double, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    Ways ways;
    ways[root] = {};
    queue.emplace(0.0, root);
    while (!queue.empty()) {
      const auto [length, v] = queue.top();
      queue.pop();
      const Way way = ways[v];
      if (length > way.length) continue;
      for_each_edge_at(table_, v, [&, from = v](std::uint32_t w, std::uint32_t corner) {
        const double longer = way.length + lengths_[corner];
        if (longer > max_length) return;
        const auto known = ways.find(w);
        if (known != ways.end() && known->second.length <= longer) return;
        ways[w] = {longer, from, way.word ^ words_[corner]};
        queue.emplace(longer, w);
      });
    }
    return ways;
  }

  [[nodiscard]] static std::vector<std::uint32_t> path(const Ways& ways, std::uint32_t a,
                                                       std::uint32_t b) {
    std::vector<std::uint32_t> vertices;
    for (std::uint32_t v = b; ways.at(v).from != kNone; v = ways.at(v).from)
      vertices.push_back(v);
    std::reverse(vertices.begin(), vertices.end());
    // From next to the root to b, over the edge to a, and back.
    for (std::uint32_t v = a; v != kNone; v = ways.at(v).from)
      vertices.push_back(v);
    return vertices;
  }

  const CornerTable& table_;
  const EdgeWords& words_;
  const std::vector<double>& lengths_;
};

/// Paths that together part the surface have words that cancel: such a one is not to be cut.
class IndependentWords {
 public:
  /// @return false if the word is a sum of those that are in
  bool add(std::uint64_t word) {
    for (const std::uint64_t other : words_)
      word = std::min(word, word ^ other);
    if (word == 0) return false;
    words_.push_back(word);
    return true;
  }

 private:
  std::vector<std::uint64_t> words_;  ///< none has the highest bit of an earlier one
};

/// What each edge adds to the length of a path, by half-edge.
std::vector<double> lengths_of(const TriangleMesh& mesh, const CornerTable& table,
                               const CloudEvidence& evidence) {
  constexpr SupportReach kReach{.pixels = 0.6, .spacings = 1.3};
  constexpr double kUnsupportedScale = 0.1;
  // A hole counts as filled, and the way across is much shorter than that around.
  constexpr double kBorderScale = 1.0 / 3.0;
  constexpr std::size_t kGrain = 1024;
  std::vector<double> lengths(table.corner_count());
  parallel_for(lengths.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto c = static_cast<std::uint32_t>(i);
      const Vec3 &a = mesh.positions[table.vertex(c)], &b = mesh.positions[table.head(c)];
      lengths[i] = glm::length(b - a);
      if (evidence.cloud == nullptr || evidence.cloud->empty()) continue;
      if (table.across(c) == kNone) {
        lengths[i] *= kBorderScale;
      } else if (!is_supported(*evidence.cloud, 0.5 * (a + b), evidence.pixel_size, kReach)) {
        lengths[i] *= kUnsupportedScale;
      }
    }
  });
  return lengths;
}

/// By the Euler number, with the holes filled.
bool has_handles(const CornerTable& table) {
  auto euler = static_cast<std::int64_t>(table.face_count() + boundary_loops(table).size());
  for (std::uint32_t v = 0; v < table.vertex_count(); ++v)
    euler += table.corner_of(v) != kNone ? 1 : 0;
  for (std::uint32_t c = 0; c < table.corner_count(); ++c)
    euler -= table.across(c) == kNone || table.names_inner_edge(c) ? 1 : 0;
  const std::vector<std::uint32_t> component = components_of(table);
  const std::int64_t components =
      component.empty() ? 0 : 1 + *std::max_element(component.begin(), component.end());
  return euler < 2 * components;
}

/// The shortest paths first. A path that parts nothing has an edge whose word is not 0, so only
/// the ends of those are asked.
std::vector<Cycle> short_cycles(const CornerTable& table, const std::vector<double>& lengths,
                                double max_length, const Progress& progress) {
  const EdgeWords words(table);
  std::vector<std::uint8_t> is_asked(table.vertex_count(), 0);
  for (std::uint32_t c = 0; c < table.corner_count(); ++c) {
    if (words[c] != 0) is_asked[table.vertex(c)] = is_asked[table.head(c)] = 1;
  }
  std::vector<std::uint32_t> asked;
  for (std::uint32_t v = 0; v < table.vertex_count(); ++v) {
    if (is_asked[v] != 0) asked.push_back(v);
  }
  constexpr std::size_t kVerticesPerBlock = 256;
  const LocalSearch search(table, words, lengths);
  std::vector<Cycle> cycles(asked.size());
  parallel_for(asked.size(), kVerticesPerBlock, [&](std::size_t begin, std::size_t end) {
    progress.check_stop();
    for (std::size_t i = begin; i < end; ++i)
      cycles[i] = search.shortest_through(asked[i], max_length);
  });
  std::erase_if(cycles, [&](const Cycle& cycle) { return cycle.vertices.empty(); });
  std::sort(cycles.begin(), cycles.end());
  return cycles;
}

std::vector<Vec3> places_along(const Cycle& cycle, const TriangleMesh& mesh) {
  std::vector<Vec3> places;
  for (const std::uint32_t v : cycle.vertices)
    places.push_back(mesh.positions[v]);
  return places;
}

/// The faces at the vertices of a path, each once.
std::vector<std::uint32_t> faces_along(const Cycle& cycle, const CornerTable& table) {
  std::vector<std::uint32_t> faces;
  for (const std::uint32_t v : cycle.vertices)
    table.for_each_corner(v, [&](std::uint32_t c) { faces.push_back(c / 3); });
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

/// Whether a path leads around the inside of a hole: most of the faces along it look inwards, and
/// points show them.
bool is_around_hole(const Cycle& cycle, const LoopDisc& disc, const TriangleMesh& mesh,
                    const CornerTable& table, const CloudEvidence& evidence) {
  constexpr double kInwards = 0.3;  // cosine
  constexpr double kLeastShare = 0.55;
  constexpr SupportReach kReach{.pixels = 0.6, .spacings = 1.0};
  const std::vector<std::uint32_t> faces = faces_along(cycle, table);
  const auto shown = std::count_if(faces.begin(), faces.end(), [&](std::uint32_t f) {
    const auto& [a, b, c] = mesh.triangles[f];
    const Vec3 center = (mesh.positions[a] + mesh.positions[b] + mesh.positions[c]) / 3.0;
    const Vec3 normal = unit_normal(mesh.positions, mesh.triangles[f]);
    return glm::dot(normal, toward_axis(disc, center)) >= kInwards &&
           is_supported(*evidence.cloud, center, evidence.pixel_size, kReach);
  });
  return static_cast<double>(shown) >= kLeastShare * static_cast<double>(faces.size());
}

/// The faces on the left of a path, then those behind them, and so on: rings that are parted from
/// the other side by the path. Faces of earlier rings are in no later one.
std::vector<std::vector<std::uint32_t>> rings_beside(const std::vector<std::uint32_t>& path,
                                                     const CornerTable& table, std::size_t count) {
  std::vector<std::vector<std::uint32_t>> rings(count);
  std::set<std::uint32_t> known;  // and those across the path
  for (std::size_t i = 0; i < path.size(); ++i) {
    const std::uint32_t c = table.half_edge(path[i], path[(i + 1) % path.size()]);
    if (c == CornerTable::kNone) continue;
    if (table.across(c) != CornerTable::kNone) known.insert(table.across(c) / 3);
    rings[0].push_back(c / 3);
  }
  known.insert(rings[0].begin(), rings[0].end());
  for (std::size_t i = 1; i < count; ++i) {
    for (const std::uint32_t f : rings[i - 1]) {
      for (std::uint32_t c = 3 * f; c < 3 * f + 3; ++c) {
        const std::uint32_t other = table.across(c);
        if (other != CornerTable::kNone && known.insert(other / 3).second)
          rings[i].push_back(other / 3);
      }
    }
  }
  return rings;
}

/// Whether a path leads around a tunnel through a wall: all faces, but for one in four, of a ring
/// beside it lie in the air.
bool is_beside_air(const Cycle& cycle, const TriangleMesh& mesh, const CornerTable& table,
                   const CloudEvidence& evidence) {
  constexpr std::size_t kRings = 3;
  const auto is_shown = [&](std::uint32_t f) {
    return is_supported(*evidence.cloud, centroid_of(mesh.positions, mesh.triangles[f]),
                        evidence.pixel_size, kCloseSupport);
  };
  const std::vector<std::uint32_t> back(cycle.vertices.rbegin(), cycle.vertices.rend());
  for (const std::vector<std::uint32_t>& path : {cycle.vertices, back}) {
    for (const std::vector<std::uint32_t>& ring : rings_beside(path, table, kRings)) {
      const auto shown = std::count_if(ring.begin(), ring.end(), is_shown);
      if (!ring.empty() && 4 * static_cast<std::size_t>(shown) <= ring.size()) return true;
    }
  }
  return false;
}

/// Paths that no object has, the shortest first.
std::vector<Cycle> false_cycles(const TriangleMesh& mesh, const CornerTable& table,
                                const ThinHandleOptions& options, const Progress& progress) {
  const std::vector<double> lengths = lengths_of(mesh, table, options.gaps);
  constexpr double kLeastHole = 3.5;  // in h, around it
  const bool has_points = options.cloud.cloud != nullptr && !options.cloud.cloud->empty();
  const double longest =
      has_points ? std::max(options.max_girth, options.filled_girth) : options.max_girth;
  std::vector<Cycle> cycles = short_cycles(table, lengths, longest, progress);
  std::erase_if(cycles, [&](const Cycle& cycle) {
    if (!has_points) return false;
    const std::vector<Vec3> path = places_along(cycle, mesh);
    const LoopDisc disc = disc_of_loop(path);
    if (is_beside_air(cycle, mesh, table, options.cloud)) return false;
    if (cycle.length > options.max_girth && !is_filled(*options.cloud.cloud, path, disc))
      return true;
    return cycle.length > kLeastHole * options.cloud.pixel_size &&
           is_around_hole(cycle, disc, mesh, table, options.cloud);
  });
  return cycles;
}

}  // namespace

std::size_t cut_thin_handles(TriangleMesh& mesh, const ThinHandleOptions& options,
                             const Progress& progress) {
  const CornerTable table(mesh.triangles, mesh.positions.size());
  if (!has_handles(table)) return 0;
  std::vector<std::uint8_t> is_dropped(mesh.triangles.size(), 0);
  std::vector<std::uint8_t> is_touched(mesh.positions.size(), 0);  // by an earlier cut
  IndependentWords cut_words;
  std::size_t cuts = 0;
  for (const Cycle& cycle : false_cycles(mesh, table, options, progress)) {
    const bool meets_cut = std::any_of(cycle.vertices.begin(), cycle.vertices.end(),
                                       [&](std::uint32_t v) { return is_touched[v] != 0; });
    if (meets_cut || !cut_words.add(cycle.word)) continue;
    for (const std::uint32_t v : cycle.vertices) {
      table.for_each_corner(v, [&](std::uint32_t c) {
        is_dropped[c / 3] = 1;
        for (const std::uint32_t corner : mesh.triangles[c / 3])
          is_touched[corner] = 1;
      });
    }
    ++cuts;
  }
  remove_triangles(mesh.triangles, is_dropped);
  return cuts;
}

}  // namespace rangezip
