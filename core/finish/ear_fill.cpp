#include "core/finish/ear_fill.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <set>
#include <utility>

#include "core/finish/faces_around.h"

namespace rangezip {
namespace {

constexpr std::size_t kMaxEdges = 2000;
constexpr double kLongestEdge = 8.0;  ///< in h
constexpr double kTurnCost = 1.0;     ///< in h, for each unit of cosine
constexpr double kNever = std::numeric_limits<double>::infinity();

using Edge = std::pair<std::uint32_t, std::uint32_t>;

class EarClipper {
 public:
  EarClipper(TriangleMesh& mesh, const CornerTable& table, FacesAround& around,
             std::set<Edge>& made, double h)
      : mesh_(mesh), table_(table), around_(around), made_(made), h_(h) {}

  /// @return the vertices of what is left of the loop
  std::vector<std::uint32_t> clip(const BoundaryLoop& loop) {
    vertices_ = vertices_of(loop, table_);
    const std::size_t n = vertices_.size();
    normals_.clear();
    for (const std::uint32_t corner : loop.corners)
      normals_.push_back(unit_normal(mesh_.positions, table_.triangle(corner / 3)));
    next_.resize(n);
    previous_.resize(n);
    cost_.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      next_[i] = (i + 1) % n;
      previous_[i] = (i + n - 1) % n;
    }
    for (std::size_t i = 0; i < n; ++i)
      cost_[i] = cost_of(i);
    is_cut_.assign(n, 0);
    left_ = n;
    while (left_ >= 3) {
      const std::size_t ear = cheapest();
      if (cost_[ear] == kNever) break;
      if (around_.can_take(face_at(ear))) {
        cut(ear);
      } else {
        cost_[ear] = kNever;  // until its neighbours change
      }
    }
    return vertices_left();
  }

 private:
  [[nodiscard]] Triangle face_at(std::size_t i) const {
    return {vertices_[previous_[i]], vertices_[i], vertices_[next_[i]]};
  }

  [[nodiscard]] double cost_of(std::size_t i) const {
    const auto [a, b, c] = face_at(i);
    const double length = glm::length(mesh_.positions[c] - mesh_.positions[a]);
    if (length > kLongestEdge * h_) return kNever;
    const bool is_last = next_[next_[i]] == previous_[i];
    if (!is_last && (table_.are_neighbors(a, c) || made_.count(std::minmax(a, c)) > 0))
      return kNever;
    const Vec3 normal = unit_normal(mesh_.positions, {a, b, c});
    const double cosine =
        std::min(glm::dot(normal, normals_[previous_[i]]), glm::dot(normal, normals_[i]));
    return length + kTurnCost * h_ * (1.0 - cosine);
  }

  [[nodiscard]] std::vector<std::uint32_t> vertices_left() const {
    std::vector<std::uint32_t> left;
    for (std::size_t i = 0; i < is_cut_.size() && left_ > 0; ++i) {
      if (is_cut_[i] == 0) left.push_back(vertices_[i]);
    }
    return left;
  }

  [[nodiscard]] std::size_t cheapest() const {
    return static_cast<std::size_t>(std::min_element(cost_.begin(), cost_.end()) - cost_.begin());
  }

  void cut(std::size_t i) {
    const Triangle face = face_at(i);
    mesh_.triangles.push_back(face);
    around_.take(face);
    if (left_ == 3) {
      left_ = 0;
      return;
    }
    const std::size_t before = previous_[i], after = next_[i];
    made_.insert(std::minmax(face[0], face[2]));
    normals_[before] = unit_normal(mesh_.positions, face);
    next_[before] = after;
    previous_[after] = before;
    cost_[i] = kNever;
    is_cut_[i] = 1;
    --left_;
    cost_[before] = cost_of(before);
    cost_[after] = cost_of(after);
  }

  TriangleMesh& mesh_;
  const CornerTable& table_;
  FacesAround& around_;
  std::set<Edge>& made_;
  double h_;
  std::vector<std::uint32_t> vertices_;
  std::vector<Vec3> normals_;  ///< of the faces across the edges from each place to the next
  std::vector<std::size_t> next_, previous_;
  std::vector<double> cost_;  ///< of the ear at each place
  std::vector<std::uint8_t> is_cut_;
  std::size_t left_ = 0;  ///< places that are not cut; 0: closed
};

}  // namespace

EarFills fill_by_ears(TriangleMesh& mesh, const CornerTable& table,
                      const std::vector<BoundaryLoop>& loops, double pixel_size) {
  EarFills fills;
  if (loops.empty()) return fills;
  const std::size_t before = mesh.triangles.size();
  std::vector<std::vector<std::uint32_t>> vertices;
  vertices.reserve(loops.size());
  for (const BoundaryLoop& loop : loops)
    vertices.push_back(vertices_of(loop, table));
  FacesAround around(mesh, vertices, pixel_size);
  std::set<Edge> made;
  EarClipper clipper(mesh, table, around, made, pixel_size);
  for (const BoundaryLoop& loop : loops) {
    const std::vector<std::uint32_t> left =
        loop.corners.size() <= kMaxEdges ? clipper.clip(loop) : vertices_of(loop, table);
    fills.left.insert(fills.left.end(), left.begin(), left.end());
  }
  fills.faces = mesh.triangles.size() - before;
  return fills;
}

}  // namespace rangezip
