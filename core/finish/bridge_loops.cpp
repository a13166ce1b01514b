#include "core/finish/bridge_loops.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "core/finish/boundary_loops.h"
#include "core/finish/components.h"
#include "core/finish/corner_table.h"

namespace rangezip {
namespace {

/// In h: how far apart the sides of a crack may be, and the longer edges of a bridge.
constexpr double kMaxGap = 3.0;
constexpr double kMaxBridgeLength = 4.0;
/// Loops run beside each other if at least this many vertices, and half of the shorter loop, do.
constexpr std::size_t kMinBeside = 4;
/// Cosines: between the two faces of a bridge, and between them and the faces beside it.
constexpr double kMinCosineInside = 0.3;
constexpr double kMinCosineBeside = -0.3;

/// A vertex of a boundary, numbered over all loops.
struct BoundaryVertex {
  Vec3 position;
  std::uint32_t loop;
  std::uint32_t place;  ///< in its loop
};

/// A vertex of one loop and the nearest one of another loop.
struct Neighbors {
  std::uint32_t loop_a, loop_b;  ///< a < b
  double distance;
  std::uint32_t place_a, place_b;

  friend bool operator<(const Neighbors& p, const Neighbors& q) {
    if (p.loop_a != q.loop_a) return p.loop_a < q.loop_a;
    if (p.loop_b != q.loop_b) return p.loop_b < q.loop_b;
    if (p.distance != q.distance) return p.distance < q.distance;
    if (p.place_a != q.place_a) return p.place_a < q.place_a;
    return p.place_b < q.place_b;
  }
};

class Bridger {
 public:
  Bridger(TriangleMesh& mesh, double pixel_size)
      : mesh_(mesh),
        h_(pixel_size),
        table_(mesh.triangles, mesh.positions.size()),
        loops_(boundary_loops(table_)),
        component_(components_of(table_)),
        joined_(component_.empty() ? 0
                                   : 1 + *std::max_element(component_.begin(), component_.end())) {
    std::iota(joined_.begin(), joined_.end(), 0U);
  }

  std::size_t run() {
    if (joined_.size() < 2) return 0;
    const std::vector<Neighbors> neighbors = find_neighbors();
    std::vector<std::uint8_t> is_bridged(loops_.size(), 0);
    std::size_t bridges = 0;
    for (std::size_t i = 0; i < neighbors.size();) {
      std::size_t end = i;
      while (end < neighbors.size() && neighbors[end].loop_a == neighbors[i].loop_a &&
             neighbors[end].loop_b == neighbors[i].loop_b) {
        ++end;
      }
      const std::uint32_t a = neighbors[i].loop_a, b = neighbors[i].loop_b;
      const std::size_t shorter = std::min(loops_[a].corners.size(), loops_[b].corners.size());
      if (is_bridged[a] == 0 && is_bridged[b] == 0 && component_of(a) != component_of(b) &&
          end - i >= std::max(kMinBeside, shorter / 2) && bridge_one({&neighbors[i], end - i})) {
        is_bridged[a] = is_bridged[b] = 1;
        join(component_of(a), component_of(b));
        ++bridges;
      }
      i = end;
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

  /// For each boundary vertex the nearest vertex of each other loop of another component.
  [[nodiscard]] std::vector<Neighbors> find_neighbors() const {
    std::vector<BoundaryVertex> vertices;
    for (std::uint32_t l = 0; l < loops_.size(); ++l) {
      for (std::uint32_t i = 0; i < loops_[l].corners.size(); ++i) {
        vertices.push_back({mesh_.positions[table_.head(loops_[l].corners[i])], l, i});
      }
    }
    // Sorted along x: those within the gap stand in a short run.
    std::sort(vertices.begin(), vertices.end(), [](const auto& p, const auto& q) {
      if (p.position.x != q.position.x) return p.position.x < q.position.x;
      return p.loop != q.loop ? p.loop < q.loop : p.place < q.place;
    });
    std::vector<Neighbors> found;
    std::vector<Neighbors> nearest;  // to one vertex, by loop
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      nearest.clear();
      collect_near(vertices, i, nearest);
      found.insert(found.end(), nearest.begin(), nearest.end());
    }
    std::sort(found.begin(), found.end());
    return found;
  }

  void collect_near(const std::vector<BoundaryVertex>& vertices, std::size_t i,
                    std::vector<Neighbors>& nearest) const {
    const BoundaryVertex& v = vertices[i];
    const double gap = kMaxGap * h_;
    const auto consider = [&](const BoundaryVertex& w) {
      if (component_of(v.loop) == component_of(w.loop)) return;
      const double distance = glm::length(v.position - w.position);
      if (distance > gap) return;
      const bool is_first = v.loop < w.loop;
      const Neighbors entry{is_first ? v.loop : w.loop, is_first ? w.loop : v.loop, distance,
                            is_first ? v.place : w.place, is_first ? w.place : v.place};
      const auto same = std::find_if(nearest.begin(), nearest.end(), [&](const Neighbors& n) {
        return n.loop_a == entry.loop_a && n.loop_b == entry.loop_b;
      });
      if (same == nearest.end()) {
        nearest.push_back(entry);
      } else if (entry < *same) {
        *same = entry;
      }
    };
    for (std::size_t k = i; k-- > 0 && v.position.x - vertices[k].position.x <= gap;) {
      consider(vertices[k]);
    }
    for (std::size_t k = i + 1; k < vertices.size() && vertices[k].position.x - v.position.x <= gap;
         ++k) {
      consider(vertices[k]);
    }
  }

  [[nodiscard]] Vec3 unit_normal(const Triangle& t) const {
    const Vec3 area =
        area_vector(mesh_.positions[t[0]], mesh_.positions[t[1]], mesh_.positions[t[2]]);
    const double length = glm::length(area);
    return length > 0.0 ? area / length : Vec3{0.0};
  }

  /// Tries the pairs of two loops, the nearest first.
  bool bridge_one(std::span<const Neighbors> pairs) {
    for (const Neighbors& pair : pairs) {
      const auto& corners_a = loops_[pair.loop_a].corners;
      const auto& corners_b = loops_[pair.loop_b].corners;
      const std::size_t nb = corners_b.size();
      // The filling direction runs a -> a2 on one side and b2 -> b on the other.
      const std::uint32_t edge_a = corners_a[pair.place_a];
      const std::uint32_t edge_b = corners_b[(pair.place_b + nb - 1) % nb];
      const std::uint32_t a = table_.head(edge_a), a2 = table_.vertex(edge_a);
      const std::uint32_t b2 = table_.head(edge_b), b = table_.vertex(edge_b);
      const Triangle first{a, a2, b}, second{a2, b2, b};
      const Vec3 n1 = unit_normal(first), n2 = unit_normal(second);
      if (glm::dot(n1, n2) < kMinCosineInside) continue;
      if (glm::dot(n1, unit_normal(table_.triangle(edge_a / 3))) < kMinCosineBeside) continue;
      if (glm::dot(n2, unit_normal(table_.triangle(edge_b / 3))) < kMinCosineBeside) continue;
      if (glm::length(mesh_.positions[a2] - mesh_.positions[b2]) > kMaxBridgeLength * h_) continue;
      mesh_.triangles.push_back(first);
      mesh_.triangles.push_back(second);
      return true;
    }
    return false;
  }

  TriangleMesh& mesh_;
  double h_;
  CornerTable table_;
  std::vector<BoundaryLoop> loops_;
  std::vector<std::uint32_t> component_;  ///< of each face
  std::vector<std::uint32_t> joined_;     ///< one name for all components that bridges joined
};

}  // namespace

std::size_t bridge_loops(TriangleMesh& mesh, double pixel_size) {
  return Bridger(mesh, pixel_size).run();
}

}  // namespace rangezip
