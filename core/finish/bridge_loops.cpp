#include "core/finish/bridge_loops.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/base/disjoint_sets.h"
#include "core/finish/loop_neighbors.h"
#include "core/finish/unsupported_faces.h"

namespace rangezip {
namespace {

/// In h: how far apart the sides of a crack may be, and the longer edges of a bridge.
constexpr double kMaxGap = 3.0;
constexpr double kMaxBridgeLength = 4.0;
constexpr std::size_t kEndsByPart = 4;  ///< of a run: an end of it is as much
constexpr std::uint32_t kApart = 3;     ///< places, between two bridges
/// In h: sides of a crack so far apart have points between them.
constexpr double kTellingGap = 1.6;
/// In h: points as near as this lie around a place, or beside it if their mean is farther from it
/// than the second figure.
constexpr double kAround = 1.0;
constexpr double kBeside = 0.65;
/// Cosines: between the two faces of a bridge, and between them and the faces beside it.
constexpr double kMinCosineInside = 0.3;
constexpr double kMinCosineBeside = -0.3;
constexpr double kMinCosineAtRim = -0.995;
/// Of the loops that part the sheets of a blade: vertices, and the share of them that are beside
/// the other loop.
constexpr std::size_t kLongRim = 40;
constexpr double kAllAround = 0.9;
/// Cosine between the faces of two sheets that meet in the sharp edge around a hole; and of the
/// places around it, how many show that.
constexpr double kSharp = 0.5;
constexpr double kSharpShare = 0.8;

/// @param component of each face
std::size_t count_components(const std::vector<std::uint32_t>& component) {
  return component.empty() ? 0 : 1 + *std::max_element(component.begin(), component.end());
}

class Bridger {
 public:
  Bridger(TriangleMesh& mesh, const MeshPieces& pieces, const PointGrid& cloud, double pixel_size,
          bool has_narrow_gaps)
      : mesh_(mesh),
        cloud_(cloud),
        h_(pixel_size),
        has_narrow_gaps_(has_narrow_gaps),
        table_(pieces.table),
        loops_(pieces.loops),
        component_(pieces.component),
        is_bridged_(loops_.size(), 0),
        joined_(count_components(component_)) {}

  /// What bridge_loops() does.
  std::size_t join_loops() {
    std::size_t bridges = 0;
    const std::vector<LoopNeighbors> neighbors =
        find_neighbors([&](std::uint32_t a, std::uint32_t b) {
          return component_of(a) != component_of(b) || (is_long(a) && is_long(b));
        });
    for (const std::span<const LoopNeighbors> pairs : loops_side_by_side(neighbors, loops_)) {
      if (!are_unbridged(pairs.front())) continue;
      between_.clear();
      may_be_rim_ = are_beside_all_around(pairs);
      if (are_of_one(pairs.front()) && !(may_be_rim_ && is_sharp(pairs))) continue;
      if (!is_crack(pairs) || !bridge_one(pairs)) continue;
      note_joined(pairs.front());
      ++bridges;
    }
    return bridges;
  }

  /// What bridge_runs() does: all runs of two loops at once, which are one component afterwards.
  std::size_t join_runs() {
    if (count_components(component_) < 2) return 0;
    std::size_t bridges = 0;
    const std::vector<std::vector<LoopNeighbors>> runs =
        parts_side_by_side(find_neighbors([&](std::uint32_t a, std::uint32_t b) {
                             return component_of(a) != component_of(b);
                           }),
                           loops_);
    for (std::size_t begin = 0, end = 0; begin < runs.size(); begin = end) {
      const LoopNeighbors& first = runs[begin].front();
      while (end < runs.size() && are_same_loops(runs[end].front(), first))
        ++end;
      if (!are_unbridged(first) || are_of_one(first)) continue;
      between_.clear();
      for (std::size_t i = begin; i < end; ++i)
        bridge_ends(runs[i]);
      if (between_.empty()) continue;
      note_joined(first);
      bridges += between_.size();
    }
    return bridges;
  }

 private:
  /// @param are_wanted as for loop_neighbors()
  template <class AreWanted>
  [[nodiscard]] std::vector<LoopNeighbors> find_neighbors(const AreWanted& are_wanted) const {
    return loop_neighbors(loops_, table_, mesh_.positions, kMaxGap * h_, are_wanted);
  }
  static bool are_same_loops(const LoopNeighbors& p, const LoopNeighbors& q) {
    return p.loop_a == q.loop_a && p.loop_b == q.loop_b;
  }
  [[nodiscard]] bool are_unbridged(const LoopNeighbors& pair) const {
    return is_bridged_[pair.loop_a] == 0 && is_bridged_[pair.loop_b] == 0;
  }
  [[nodiscard]] bool are_of_one(const LoopNeighbors& pair) {
    return component_of(pair.loop_a) == component_of(pair.loop_b);
  }
  void note_joined(const LoopNeighbors& pair) {
    is_bridged_[pair.loop_a] = is_bridged_[pair.loop_b] = 1;
    joined_.join(component_of(pair.loop_a), component_of(pair.loop_b));
  }

  /// At both ends of a run: what lies between becomes a loop of its own.
  void bridge_ends(std::vector<LoopNeighbors> run) {
    if (!is_crack(run)) return;
    const auto part = static_cast<std::ptrdiff_t>(run.size() / kEndsByPart);
    std::sort(run.begin(), run.begin() + part);
    std::sort(run.end() - part, run.end());
    bridge_one({run.begin(), run.begin() + part});
    bridge_one({run.end() - part, run.end()});
  }

  /// Whether a bridge more between the same loops makes a hole of them, as what lies between two
  /// bridges is, rather than a handle: as places follow along one loop, they go back on the other.
  [[nodiscard]] bool is_in_order(const LoopNeighbors& pair) const {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> places{{pair.place_a, pair.place_b}};
    for (const LoopNeighbors& other : between_)
      places.emplace_back(other.place_a, other.place_b);
    std::sort(places.begin(), places.end());
    const auto na = static_cast<std::uint32_t>(loops_[pair.loop_a].corners.size());
    const auto nb = static_cast<std::uint32_t>(loops_[pair.loop_b].corners.size());
    std::uint32_t back = 0;  // along the second loop, from each place to the next one
    for (std::size_t i = 0; places.size() > 1 && i < places.size(); ++i) {
      const auto& [a, b] = places[i];
      const auto& [next_a, next_b] = places[(i + 1) % places.size()];
      const std::uint32_t step_a = (next_a + na - a) % na, step_b = (b + nb - next_b) % nb;
      if (step_a < kApart || step_b < kApart) return false;
      back += step_b;
    }
    return back <= nb;
  }

  /// One name for all that bridges joined: a second bridge between the two would make a handle.
  [[nodiscard]] std::uint32_t component_of(std::uint32_t loop) {
    return joined_.find(component_[loops_[loop].corners[0] / 3]);
  }

  [[nodiscard]] Vec3 normal_of(const Triangle& t) const { return unit_normal(mesh_.positions, t); }

  /// Whether the cloud, if there is one, has points half way between two vertices, and beside
  /// narrow gaps not only on one side of that place, as at the edge of a wall.
  [[nodiscard]] bool is_shown(std::uint32_t a, std::uint32_t b) const {
    const Vec3 middle = 0.5 * (mesh_.positions[a] + mesh_.positions[b]);
    return cloud_.empty() || (is_supported(cloud_, middle, h_, kCloseSupport) &&
                              !(has_narrow_gaps_ && is_beside_points(middle)));
  }

  [[nodiscard]] bool is_beside_points(const Vec3& place) const {
    Vec3 sum{0.0};
    std::size_t count = 0;
    cloud_.for_each_near(place, kAround * h_, [&](const Vec3& offset) {
      if (glm::length(offset) > kAround * h_) return;
      sum += offset;
      ++count;
    });
    return glm::length(sum) > kBeside * h_ * static_cast<double>(count);
  }

  /// Whether there is a surface between two loops, at half of the places at least where they are so
  /// far apart that points tell.
  [[nodiscard]] bool is_crack(std::span<const LoopNeighbors> pairs) const {
    std::size_t wide = 0, shown = 0;
    for (const LoopNeighbors& pair : pairs) {
      if (pair.distance < kTellingGap * h_) continue;
      ++wide;
      const auto& corners_a = loops_[pair.loop_a].corners;
      const auto& corners_b = loops_[pair.loop_b].corners;
      shown += is_shown(table_.head(corners_a[pair.place_a]), table_.head(corners_b[pair.place_b]))
                   ? 1
                   : 0;
    }
    return 2 * shown >= wide;
  }

  [[nodiscard]] bool is_long(std::uint32_t loop) const {
    return loops_[loop].corners.size() >= kLongRim;
  }

  /// Whether two loops may be the sides of a rim: long ones, for around a hole of some pixels the
  /// scraps of a scene face each other, too.
  [[nodiscard]] bool are_beside_all_around(std::span<const LoopNeighbors> pairs) const {
    const auto& [a, b] = std::pair{pairs.front().loop_a, pairs.front().loop_b};
    const std::size_t count = loops_[a].corners.size() + loops_[b].corners.size();
    return is_long(a) && is_long(b) &&
           static_cast<double>(pairs.size()) >= kAllAround * static_cast<double>(count);
  }

  /// Whether two loops are the sides of a sharp edge all around: the faces beside them look in
  /// different directions, and each lies behind the other.
  [[nodiscard]] bool is_sharp(std::span<const LoopNeighbors> pairs) const {
    const auto sharp = std::count_if(pairs.begin(), pairs.end(), [&](const LoopNeighbors& pair) {
      const std::uint32_t a = loops_[pair.loop_a].corners[pair.place_a];
      const std::uint32_t b = loops_[pair.loop_b].corners[pair.place_b];
      return glm::dot(normal_of(table_.triangle(a / 3)), normal_of(table_.triangle(b / 3))) <
                 kSharp &&
             lies_behind(a, b) && lies_behind(b, a);
    });
    return static_cast<double>(sharp) >= kSharpShare * static_cast<double>(pairs.size());
  }

  /// Whether the face of one border edge, with its corner across, lies behind that of another.
  [[nodiscard]] bool lies_behind(std::uint32_t edge, std::uint32_t other) const {
    const Triangle& face = table_.triangle(other / 3);
    const Vec3 to = mesh_.positions[table_.apex(edge)] - mesh_.positions[table_.head(other)];
    return glm::dot(to, normal_of(face)) < 0.0;
  }

  /// Whether a face with this normal may follow on the face of a border edge: what turns back on it
  /// is the rim of a blade if the sheet that it leads to, with the vertex `across`, lies behind; in
  /// front it would close a gap.
  [[nodiscard]] bool may_turn(std::uint32_t edge, const Vec3& normal, std::uint32_t across) const {
    const Vec3 beside = normal_of(table_.triangle(edge / 3));
    const double cosine = glm::dot(normal, beside);
    if (cosine >= kMinCosineBeside) return true;
    const Vec3 to = mesh_.positions[across] - mesh_.positions[table_.head(edge)];
    return may_be_rim_ && cosine >= kMinCosineAtRim && glm::dot(to, beside) < 0.0;
  }

  /// Tries the pairs of two loops, the nearest first.
  bool bridge_one(std::span<const LoopNeighbors> pairs) {
    for (const LoopNeighbors& pair : pairs) {
      const auto& corners_a = loops_[pair.loop_a].corners;
      const auto& corners_b = loops_[pair.loop_b].corners;
      const std::size_t nb = corners_b.size();
      // The filling direction runs a -> a2 on one side and b2 -> b on the other.
      const std::uint32_t edge_a = corners_a[pair.place_a];
      const std::uint32_t edge_b = corners_b[(pair.place_b + nb - 1) % nb];
      const std::uint32_t a = table_.head(edge_a), a2 = table_.vertex(edge_a);
      const std::uint32_t b2 = table_.head(edge_b), b = table_.vertex(edge_b);
      const Triangle first{a, a2, b}, second{a2, b2, b};
      const Vec3 n1 = normal_of(first), n2 = normal_of(second);
      if (glm::dot(n1, n2) < kMinCosineInside) continue;
      if (!may_turn(edge_a, n1, b) || !may_turn(edge_b, n2, a)) continue;
      if (glm::length(mesh_.positions[a2] - mesh_.positions[b2]) > kMaxBridgeLength * h_) continue;
      if (!is_shown(a, b) || !is_shown(a2, b) || !is_shown(a2, b2)) continue;
      if (!is_in_order(pair)) continue;
      between_.push_back(pair);
      mesh_.triangles.push_back(first);
      mesh_.triangles.push_back(second);
      return true;
    }
    return false;
  }

  TriangleMesh& mesh_;
  const PointGrid& cloud_;
  double h_;
  bool has_narrow_gaps_;
  const CornerTable& table_;
  const std::vector<BoundaryLoop>& loops_;
  const std::vector<std::uint32_t>& component_;
  std::vector<std::uint8_t> is_bridged_;  ///< of loops
  DisjointSets joined_;                   ///< components, by bridges
  bool may_be_rim_ = false;               ///< what parts the two loops that are joined
  std::vector<LoopNeighbors> between_;    ///< the two loops that are joined: bridges so far
};

}  // namespace

std::size_t bridge_loops(TriangleMesh& mesh, const MeshPieces& pieces, const PointGrid& cloud,
                         double pixel_size, bool has_narrow_gaps) {
  return Bridger(mesh, pieces, cloud, pixel_size, has_narrow_gaps).join_loops();
}

std::size_t bridge_runs(TriangleMesh& mesh, const MeshPieces& pieces, const PointGrid& cloud,
                        double pixel_size, bool has_narrow_gaps) {
  return Bridger(mesh, pieces, cloud, pixel_size, has_narrow_gaps).join_runs();
}

}  // namespace rangezip
