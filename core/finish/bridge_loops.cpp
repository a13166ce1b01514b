#include "core/finish/bridge_loops.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "core/finish/loop_neighbors.h"
#include "core/finish/unsupported_faces.h"

namespace rangezip {
namespace {

/// In h: how far apart the sides of a crack may be, and the longer edges of a bridge.
constexpr double kMaxGap = 3.0;
constexpr double kMaxBridgeLength = 4.0;
/// In h: sides of a crack so far apart have points between them.
constexpr double kTellingGap = 1.6;
/// Cosines: between the two faces of a bridge, and between them and the faces beside it.
constexpr double kMinCosineInside = 0.3;
constexpr double kMinCosineBeside = -0.3;

class Bridger {
 public:
  Bridger(TriangleMesh& mesh, const MeshPieces& pieces, const PointGrid& cloud, double pixel_size)
      : mesh_(mesh),
        cloud_(cloud),
        h_(pixel_size),
        table_(pieces.table),
        loops_(pieces.loops),
        component_(pieces.component),
        joined_(component_.empty() ? 0
                                   : 1 + *std::max_element(component_.begin(), component_.end())) {
    std::iota(joined_.begin(), joined_.end(), 0U);
  }

  std::size_t run() {
    if (joined_.size() < 2) return 0;
    const std::vector<LoopNeighbors> neighbors = loop_neighbors(
        loops_, table_, mesh_.positions, kMaxGap * h_,
        [&](std::uint32_t a, std::uint32_t b) { return component_of(a) != component_of(b); });
    std::vector<std::uint8_t> is_bridged(loops_.size(), 0);
    std::size_t bridges = 0;
    for (const std::span<const LoopNeighbors> pairs : loops_side_by_side(neighbors, loops_)) {
      const std::uint32_t a = pairs.front().loop_a, b = pairs.front().loop_b;
      if (is_bridged[a] != 0 || is_bridged[b] != 0 || component_of(a) == component_of(b)) continue;
      if (!bridge_one(pairs)) continue;
      is_bridged[a] = is_bridged[b] = 1;
      join(component_of(a), component_of(b));
      ++bridges;
    }
    return bridges;
  }

 private:
  [[nodiscard]] std::uint32_t component_of(std::uint32_t loop) const {
    return joined_[component_[loops_[loop].corners[0] / 3]];
  }
  /// A second bridge between the two would make a handle.
  void join(std::uint32_t a, std::uint32_t b) {
    std::replace(joined_.begin(), joined_.end(), b, a);
  }

  [[nodiscard]] Vec3 normal_of(const Triangle& t) const { return unit_normal(mesh_.positions, t); }

  /// Whether the cloud, if there is one, has points half way between two vertices.
  [[nodiscard]] bool is_shown(std::uint32_t a, std::uint32_t b) const {
    const Vec3 middle = 0.5 * (mesh_.positions[a] + mesh_.positions[b]);
    return cloud_.empty() || is_supported(cloud_, middle, h_, kCloseSupport);
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

  /// Tries the pairs of two loops, the nearest first.
  bool bridge_one(std::span<const LoopNeighbors> pairs) {
    if (!is_crack(pairs)) return false;
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
      if (glm::dot(n1, normal_of(table_.triangle(edge_a / 3))) < kMinCosineBeside) continue;
      if (glm::dot(n2, normal_of(table_.triangle(edge_b / 3))) < kMinCosineBeside) continue;
      if (glm::length(mesh_.positions[a2] - mesh_.positions[b2]) > kMaxBridgeLength * h_) continue;
      if (!is_shown(a, b) || !is_shown(a2, b) || !is_shown(a2, b2)) continue;
      mesh_.triangles.push_back(first);
      mesh_.triangles.push_back(second);
      return true;
    }
    return false;
  }

  TriangleMesh& mesh_;
  const PointGrid& cloud_;
  double h_;
  const CornerTable& table_;
  const std::vector<BoundaryLoop>& loops_;
  const std::vector<std::uint32_t>& component_;
  std::vector<std::uint32_t> joined_;  ///< one name for all components that bridges joined
};

}  // namespace

std::size_t bridge_loops(TriangleMesh& mesh, const MeshPieces& pieces, const PointGrid& cloud,
                         double pixel_size) {
  return Bridger(mesh, pieces, cloud, pixel_size).run();
}

}  // namespace rangezip
