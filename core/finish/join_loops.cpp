#include "core/finish/join_loops.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "core/base/parallel.h"
#include "core/finish/clean_topology.h"
#include "core/finish/hole_choice.h"
#include "core/finish/hole_filling.h"
#include "core/finish/loop_neighbors.h"
#include "core/finish/loop_triangulation.h"
#include "core/finish/unsupported_faces.h"
#include "core/finish/verified_fills.h"
#include "core/mesh/coverage.h"

namespace rangezip {
namespace {

/// In h: how far apart the loops are, and the longest edges of a strip.
constexpr double kMaxGap = 3.0;
constexpr double kMaxEdge = 4.0;
/// In h: no point tells what lies across a narrower gap.
constexpr double kTooNarrow = 1.2;
/// In h: points in the middle of a wider gap are those of no sheet beside it.
constexpr double kWide = 2.4;
/// How near the middle of a strip's edge has a point; the same beside narrow gaps, of which 1.3
/// spacings may be half; and where the gap is wide.
constexpr SupportReach kSupport{.pixels = 0.6, .spacings = 1.3};
constexpr SupportReach kSupportBesideGaps{.pixels = 0.6, .spacings = 1.0};
constexpr SupportReach kWideSupport{.pixels = 0.9, .spacings = 1.3};
/// Of the middles of long edges; the same where a fill would lie in the air.
constexpr double kMinSupported = 0.7;
constexpr double kMinSupportedInAir = 0.3;
/// In h: a middle nearer to the mesh lies on what the mesh has already, as between two holes beside
/// each other; so may this share of a strip's middles.
constexpr double kCovered = 0.35;
constexpr double kMaxCovered = 0.35;
constexpr double kMaxCoveredInAir = 0.5;   // where a fill would lie in the air
constexpr double kMaxCoveredInPart = 0.2;  // of a strip of which a part may be made
/// Mean cosines between a strip and the faces beside it: shown by points, the same where the gap is
/// wide, and shown by no point.
constexpr double kMinShown = 0.3;
constexpr double kMinShownWide = -0.25;
constexpr double kMinContinued = 0.5;
/// Neighbours that are tried as the seam of a strip, at least, the nearest first.
constexpr std::size_t kSeams = 12;
/// In h, around a loop; and mean cosine between its fill and the faces beside it. Such a hole is
/// not the end of another.
constexpr double kNick = 6.0;
constexpr double kNickContinued = 0.8;
/// Of a strip's faces: without those that cross something.
constexpr double kLeastPart = 0.8;
/// Strips of a loop that are tried.
constexpr int kAttempts = 4;
/// Longer loops are borders rather than rims of holes, and their fills take long.
constexpr std::size_t kMaxEdges = 300;

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// A strip between two loops, and what tells whether the object has it.
struct Strip {
  std::uint32_t loop_a = 0, loop_b = 0;
  HoleFill fill;
  std::vector<Vec3> middles;    ///< of its long edges
  double mean_edge = 0.0;       ///< of all inner edges
  bool is_shown = false;        ///< points can tell: most edges are long
  bool is_sure = false;         ///< so much that a part of it is better than none
  bool is_through_air = false;  ///< a fill would lie in it, and be wrong
};

/// A loop as one side of a strip, in filling order.
struct Side {
  std::vector<std::uint32_t> vertices;
  std::vector<Vec3> edge_normals;  ///< of the faces across
};

/// A loop from one place once around, that one twice.
void append_around(const Side& side, std::uint32_t place, std::vector<std::uint32_t>& polygon,
                   std::vector<Vec3>& edge_normals) {
  const std::size_t n = side.vertices.size();
  for (std::size_t i = 0; i < n; ++i) {
    polygon.push_back(side.vertices[(place + i) % n]);
    edge_normals.push_back(side.edge_normals[(place + i) % n]);
  }
  polygon.push_back(side.vertices[place]);
  edge_normals.emplace_back(0.0);  // of the seam
}

bool has_repeated_edge(const std::vector<Triangle>& triangles) {
  std::vector<Edge> edges;
  for (const Triangle& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i)
      edges.emplace_back(t[i], t[(i + 1) % 3]);
  }
  std::sort(edges.begin(), edges.end());
  return std::adjacent_find(edges.begin(), edges.end()) != edges.end();
}

/// The edges of a strip that are no edges of the loops, each once.
std::vector<Edge> inner_edges(const std::vector<Triangle>& triangles) {
  std::vector<Edge> edges;
  for (const Triangle& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i)
      edges.push_back(std::minmax(t[i], t[(i + 1) % 3]));
  }
  std::sort(edges.begin(), edges.end());
  std::vector<Edge> inner;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    if (edges[i] == edges[i + 1]) inner.push_back(edges[i]);
  }
  return inner;
}

class Joiner {
 public:
  Joiner(const TriangleMesh& mesh, const MeshPieces& pieces, const PointGrid& cloud,
         double pixel_size, bool has_narrow_gaps, const Progress& progress)
      : mesh_(mesh),
        cloud_(cloud),
        h_(pixel_size),
        support_(has_narrow_gaps ? kSupportBesideGaps : kSupport),
        table_(pieces.table),
        loops_(pieces.loops),
        component_(pieces.component),
        progress_(progress) {}

  /// The strips that are surface of the object, the narrowest first; some may share a loop.
  [[nodiscard]] std::vector<Strip> strips() const {
    if (loops_.size() < 2) return {};
    const auto are_wanted = [&](std::uint32_t a, std::uint32_t b) {
      return std::max(loops_[a].corners.size(), loops_[b].corners.size()) <= kMaxEdges;
    };
    const std::vector<LoopNeighbors> neighbors =
        loop_neighbors(loops_, table_, mesh_.positions, kMaxGap * h_, are_wanted);
    const std::vector<std::span<const LoopNeighbors>> pairs = loops_side_by_side(neighbors, loops_);
    std::vector<std::optional<Strip>> made(pairs.size());
    parallel_for(pairs.size(), 1, [&](std::size_t begin, std::size_t end) {
      progress_.check_stop();
      for (std::size_t i = begin; i < end; ++i)
        made[i] = strip_between(pairs[i]);
    });
    std::vector<Strip> strips;
    for (std::optional<Strip>& strip : made) {
      if (strip) strips.push_back(std::move(*strip));
    }
    strips = surfaces_among(std::move(strips));
    std::stable_sort(strips.begin(), strips.end(),
                     [](const Strip& a, const Strip& b) { return a.mean_edge < b.mean_edge; });
    return strips;
  }

 private:
  /// Those that are surface of the object.
  [[nodiscard]] std::vector<Strip> surfaces_among(std::vector<Strip> strips) const {
    std::vector<Vec3> middles;
    std::vector<std::size_t> first;
    for (const Strip& strip : strips) {
      first.push_back(middles.size());
      middles.insert(middles.end(), strip.middles.begin(), strip.middles.end());
    }
    if (strips.empty()) return strips;
    const std::vector<std::uint8_t> is_covered = covered_points(middles, mesh_, kCovered * h_);
    std::vector<std::uint8_t> is_kept(strips.size(), 0);
    parallel_for(strips.size(), 1, [&](std::size_t begin, std::size_t end) {
      progress_.check_stop();
      for (std::size_t i = begin; i < end; ++i) {
        const auto covered = std::span(is_covered).subspan(first[i], strips[i].middles.size());
        is_kept[i] = is_surface(strips[i], covered) ? 1 : 0;
      }
    });
    std::vector<Strip> kept;
    for (std::size_t i = 0; i < strips.size(); ++i) {
      if (is_kept[i] != 0) kept.push_back(std::move(strips[i]));
    }
    return kept;
  }

  /// The strip between two loops, if there is one without long edges.
  [[nodiscard]] std::optional<Strip> strip_between(std::span<const LoopNeighbors> pairs) const {
    const Side a = side_of(pairs.front().loop_a), b = side_of(pairs.front().loop_b);
    const std::size_t step = std::max<std::size_t>(1, pairs.size() / kSeams);
    for (std::size_t i = 0; i < pairs.size(); i += step) {
      Strip strip{.loop_a = pairs[i].loop_a,
                  .loop_b = pairs[i].loop_b,
                  .fill = {triangulate(a, b, pairs[i]), {}}};
      if (strip.fill.triangles.empty()) continue;
      measure(strip);
      return strip;
    }
    return std::nullopt;
  }

  [[nodiscard]] Side side_of(std::uint32_t loop) const {
    return {vertices_of(loops_[loop], table_),
            shape_of(loops_[loop], table_, mesh_.positions).edge_normals};
  }

  /// Around one loop, over the seam, around the other and back: a polygon that has every vertex
  /// once, and the ends of the seam twice. Empty if there is no manifold triangulation.
  [[nodiscard]] std::vector<Triangle> triangulate(const Side& a, const Side& b,
                                                  const LoopNeighbors& seam) const {
    std::vector<std::uint32_t> polygon;
    LoopShape shape;
    append_around(a, seam.place_a, polygon, shape.edge_normals);
    append_around(b, seam.place_b, polygon, shape.edge_normals);
    for (const std::uint32_t v : polygon)
      shape.points.push_back(mesh_.positions[v]);
    const Edge seam_edge = std::minmax(a.vertices[seam.place_a], b.vertices[seam.place_b]);
    if (table_.are_neighbors(seam_edge.first, seam_edge.second)) return {};
    shape.longest_edge = kMaxEdge * h_;
    for (std::uint32_t i = 0; i < polygon.size(); ++i) {
      for (std::uint32_t k = 0; k < polygon.size(); ++k) {
        const std::uint32_t v = polygon[i], w = polygon[k];
        if (shape.is_too_long(i, k)) continue;
        if (v == w || Edge(std::minmax(v, w)) == seam_edge || table_.are_neighbors(v, w))
          shape.forbidden.emplace_back(i, k);
      }
    }
    std::vector<Triangle> triangles = triangulate_loop(shape);
    for (Triangle& t : triangles) {
      for (std::uint32_t& v : t)
        v = polygon[v];
    }
    if (has_repeated_edge(triangles)) return {};
    return triangles;
  }

  void measure(Strip& strip) const {
    const std::vector<Edge> edges = inner_edges(strip.fill.triangles);
    for (const auto& [v, w] : edges) {
      const Vec3 &p = mesh_.positions[v], &q = mesh_.positions[w];
      const double length = glm::length(q - p);
      strip.mean_edge += length / static_cast<double>(edges.size());
      if (length >= kTooNarrow * h_) strip.middles.push_back(0.5 * (p + q));
    }
    strip.is_shown = !cloud_.empty() && 2 * strip.middles.size() >= edges.size();
  }

  /// Also finds out whether the strip leads through air.
  /// @param is_covered by the mesh, of each middle
  [[nodiscard]] bool is_surface(Strip& strip, std::span<const std::uint8_t> is_covered) const {
    const double continued = continuation_of_strip(strip);
    const bool is_of_one = component_of(strip.loop_a) == component_of(strip.loop_b);
    if (!strip.is_shown && !is_of_one) return false;
    if (!strip.is_shown)
      return continued >= kMinContinued && continued > continuation_of_fills(strip);
    const bool is_wide = strip.mean_edge >= kWide * h_;
    if (continued < (is_wide ? kMinShownWide : kMinShown)) return false;
    if (is_nick(strip.loop_a) || is_nick(strip.loop_b)) return false;
    const auto count = static_cast<double>(strip.middles.size());
    const auto covered = static_cast<double>(std::count(is_covered.begin(), is_covered.end(), 1));
    const Inside a = inside_of(strip.loop_a), b = inside_of(strip.loop_b);
    const bool is_air = a == Inside::air || b == Inside::air;
    const bool has_points = a == Inside::points || b == Inside::points;
    if (has_points && !is_air) return false;
    strip.is_through_air = is_air;
    if (!is_air && (!is_of_one || continued <= continuation_of_fills(strip))) return false;
    if (covered > (is_air ? kMaxCoveredInAir : kMaxCovered) * count) return false;
    const auto supported =
        std::count_if(strip.middles.begin(), strip.middles.end(), [&](const Vec3& middle) {
          return is_supported(cloud_, middle, h_, is_wide ? kWideSupport : support_);
        });
    const double least = is_air && is_of_one && !has_points ? kMinSupportedInAir : kMinSupported;
    if (static_cast<double>(supported) < least * count) return false;
    strip.is_sure = is_air || (covered <= kMaxCoveredInPart * count && !are_in_sheets(strip));
    return true;
  }

  /// Whether both loops might be mere holes in smooth sheets.
  [[nodiscard]] bool are_in_sheets(const Strip& strip) const {
    return std::min(continuation_of_fill(strip.loop_a), continuation_of_fill(strip.loop_b)) >
           kNickContinued;
  }

  [[nodiscard]] double continuation_of_strip(const Strip& strip) const {
    const auto &a = loops_[strip.loop_a].corners, &b = loops_[strip.loop_b].corners;
    std::vector<std::uint32_t> corners(a);
    corners.insert(corners.end(), b.begin(), b.end());
    return continuation_of(mesh_.positions, table_, corners, strip.fill.triangles);
  }

  /// Of the better one.
  [[nodiscard]] double continuation_of_fills(const Strip& strip) const {
    return std::max(continuation_of_fill(strip.loop_a), continuation_of_fill(strip.loop_b));
  }

  [[nodiscard]] double continuation_of_fill(std::uint32_t loop) const {
    const HoleFill fill = fill_loop(mesh_.positions, table_, loops_[loop], FillShape::coarse, 0.0);
    return continuation_of(mesh_.positions, table_, loops_[loop].corners, fill.triangles);
  }

  /// A hole of one or two triangles in a smooth sheet.
  [[nodiscard]] bool is_nick(std::uint32_t loop) const {
    return perimeter_of(loops_[loop], table_, mesh_.positions) < kNick * h_ &&
           continuation_of_fill(loop) > kNickContinued;
  }

  [[nodiscard]] std::uint32_t component_of(std::uint32_t loop) const {
    return component_[loops_[loop].corners[0] / 3];
  }

  [[nodiscard]] Inside inside_of(std::uint32_t loop) const {
    return inside_of_fill(mesh_.positions, table_, loops_[loop], cloud_, h_);
  }

  const TriangleMesh& mesh_;
  const PointGrid& cloud_;
  double h_;
  SupportReach support_;
  const CornerTable& table_;
  const std::vector<BoundaryLoop>& loops_;
  const std::vector<std::uint32_t>& component_;
  const Progress& progress_;
};

void mark(const Strip& strip, std::vector<std::uint8_t>& vertices) {
  for (const Triangle& t : strip.fill.triangles) {
    for (const std::uint32_t v : t)
      vertices[v] = 1;
  }
}

std::vector<HoleFill> fills_of(const std::vector<Strip>& strips) {
  std::vector<HoleFill> fills;
  fills.reserve(strips.size());
  for (const Strip& strip : strips)
    fills.push_back(strip.fill);
  return fills;
}

/// The first strip of each loop that is not joined. @return the others
std::vector<Strip> take_one_for_each_loop(std::vector<Strip>& strips,
                                          std::vector<std::uint8_t> is_joined) {
  std::vector<Strip> chosen, others;
  for (Strip& strip : strips) {
    const bool is_free = is_joined[strip.loop_a] == 0 && is_joined[strip.loop_b] == 0;
    if (is_free) is_joined[strip.loop_a] = is_joined[strip.loop_b] = 1;
    (is_free ? chosen : others).push_back(std::move(strip));
  }
  strips = std::move(chosen);
  return others;
}

/// Appends of strips what crosses nothing, where that is most of a strip: what is left open is
/// filled as other holes are. Names the loops of others.
void append_parts(TriangleMesh& mesh, const std::vector<Strip>& strips, JoinedLoops& joined,
                  const Progress& progress) {
  const std::vector<HoleFill> parts = without_crossing_faces(mesh, fills_of(strips), progress);
  const std::size_t before = mesh.triangles.size();
  for (std::size_t i = 0; i < strips.size(); ++i) {
    const auto whole = static_cast<double>(strips[i].fill.triangles.size());
    if (static_cast<double>(parts[i].triangles.size()) >= kLeastPart * whole) {
      append_fill(mesh, parts[i], mesh.positions.size());
      ++joined.pairs;
    } else if (strips[i].is_through_air) {
      mark(strips[i], joined.is_hindered);
    }
  }
  if (mesh.triangles.size() > before) clean_topology(mesh);  // parts may touch in a vertex
}

}  // namespace

JoinedLoops join_loops(TriangleMesh& mesh, const MeshPieces& pieces, const PointGrid& cloud,
                       double pixel_size, bool has_narrow_gaps, const Progress& progress) {
  JoinedLoops result{.is_hindered = std::vector<std::uint8_t>(mesh.positions.size(), 0)};
  std::vector<std::uint8_t> is_joined(pieces.loops.size(), 0);
  std::vector<Strip> strips =
      Joiner(mesh, pieces, cloud, pixel_size, has_narrow_gaps, progress).strips();
  std::vector<Strip> hindered;
  for (int attempt = 0; attempt < kAttempts && !strips.empty(); ++attempt) {
    std::vector<Strip> others = take_one_for_each_loop(strips, is_joined);
    std::vector<std::uint8_t> fails(strips.size(), 0);
    for (const std::size_t i : append_verified(mesh, fills_of(strips), progress))
      fails[i] = 1;
    for (std::size_t i = 0; i < strips.size(); ++i) {
      if (fails[i] != 0) {
        hindered.push_back(std::move(strips[i]));
        continue;
      }
      is_joined[strips[i].loop_a] = is_joined[strips[i].loop_b] = 1;
      ++result.pairs;
    }
    strips = std::move(others);
  }
  std::erase_if(hindered, [](const Strip& strip) { return !strip.is_sure; });
  take_one_for_each_loop(hindered, is_joined);
  append_parts(mesh, hindered, result, progress);
  return result;
}

}  // namespace rangezip
