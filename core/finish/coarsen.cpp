#include "core/finish/coarsen.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <queue>
#include <utility>
#include <vector>

#include "core/base/solve.h"
#include "core/finish/corner_table.h"
#include "core/finish/triangle_shape.h"
#include "core/finish/vertex_geometry.h"

namespace rangezip {
namespace {

// Angles as cosines, smallest angles as sines.
constexpr std::array kSmallestAngles{0.259, 0.174, 0.087};  // 15 degrees; 10 and 5 if they must
constexpr double kGoodAngle = 0.6;                          // 37 degrees: smaller ones cost more
constexpr double kMostTurn = 0.5;
/// Of an edge: so far off the surface is as good as on it, the short edge then goes first.
constexpr double kHardlyOff = 0.02;
/// What holds a vertex in the middle of its edge where its planes leave it free, in their weight.
constexpr double kHold = 0.001;
constexpr std::size_t kCollapsesPerCheck = 4096;

/// The sum of squared distances of a place from planes, by weight, relative to the vertex.
struct Quadric {
  Mat3 products{0.0};
  Vec3 right{0.0};
  double constant = 0.0;
  double weight = 0.0;

  /// Of a plane through the vertex.
  void add_plane(const Vec3& normal, double of_weight) {
    products += of_weight * glm::outerProduct(normal, normal);
    weight += of_weight;
  }
  [[nodiscard]] Quadric seen_from(const Vec3& place) const {
    const Vec3 moved = products * place;
    return {products, right - moved,
            constant - 2.0 * glm::dot(right, place) + glm::dot(place, moved), weight};
  }
  [[nodiscard]] double at(const Vec3& place) const {
    const double sum = glm::dot(place, products * place) - 2.0 * glm::dot(right, place) + constant;
    return std::max(sum, 0.0);
  }
};

Quadric operator+(const Quadric& a, const Quadric& b) {
  return {a.products + b.products, a.right + b.right, a.constant + b.constant, a.weight + b.weight};
}

/// Where the sum is least, near the origin in directions that the planes leave free. The second
/// step takes back how far the first was held off the planes.
Vec3 best_place(const Quadric& planes) {
  const double hold = kHold * planes.weight;
  Vec3 place{0.0};
  for (int step = 0; step < 2; ++step)
    place = solve(planes.products + Mat3(hold), planes.right + hold * place, 0.0).value_or(place);
  return place;
}

/// What collapsing an edge would cost, and where its vertex would go, as long as its ends stay.
struct Candidate {
  double cost = 0.0;
  std::uint32_t a = 0, b = 0;  ///< ends, the lower one first
  std::uint32_t changes_of_a = 0, changes_of_b = 0;
  Vec3 place{0.0};
};

struct ComesLater {
  bool operator()(const Candidate& x, const Candidate& y) const {
    if (x.cost != y.cost) return x.cost > y.cost;
    return std::pair(x.a, x.b) > std::pair(y.a, y.b);
  }
};

class Coarsener {
 public:
  Coarsener(TriangleMesh& mesh, const CoarsenOptions& options)
      : positions_(mesh.positions),
        options_(options),
        table_(mesh.triangles, mesh.positions.size()),
        faces_(mesh.triangles.size()),
        quadrics_(mesh.positions.size()),
        changes_(mesh.positions.size(), 0) {
    for (std::uint32_t f = 0; f < table_.face_count(); ++f)
      add_planes_of(f);
  }

  std::size_t run(const Progress& progress) {
    std::size_t count = 0;
    for (const double angle : kSmallestAngles) {
      smallest_angle_ = angle;
      queue_all();
      while (!queue_.empty() && faces_ > options_.triangles) {
        if (count % kCollapsesPerCheck == 0) progress.check_stop();
        const Candidate best = queue_.top();
        queue_.pop();
        if (is_current(best) && collapse(best)) ++count;
      }
      if (faces_ <= options_.triangles || options_.triangles == 0) break;
    }
    return count;
  }
  [[nodiscard]] std::vector<Triangle> triangles() const { return table_.triangles(); }

 private:
  [[nodiscard]] const Vec3& at(std::uint32_t vertex) const { return positions_[vertex]; }
  [[nodiscard]] bool is_kept(std::uint32_t vertex) const {
    return !options_.is_kept.empty() && options_.is_kept[vertex] != 0;
  }

  /// A third of the face counts at each corner; what stands on a boundary edge as much as a square
  /// over it.
  void add_planes_of(std::uint32_t face) {
    const Vec3 area = face_area_vector(table_, positions_, face);
    const double size = glm::length(area);
    if (!(size > 0.0)) return;
    for (std::uint32_t c = 3 * face; c < 3 * face + 3; ++c) {
      const std::uint32_t v = table_.vertex(c), w = table_.head(c);
      quadrics_[v].add_plane(area / size, size / 6.0);
      if (table_.across(c) != CornerTable::kNone) continue;
      const Vec3 outward = glm::cross(at(w) - at(v), area / size);
      const double length = glm::length(outward);
      if (!(length > 0.0)) continue;
      for (const std::uint32_t end : {v, w})
        quadrics_[end].add_plane(outward / length, 0.5 * length * length);
    }
  }

  void queue_all() {
    queue_ = {};
    for (std::uint32_t c = 0; c < table_.corner_count(); ++c) {
      if (table_.is_deleted(c / 3)) continue;
      const bool is_boundary = table_.across(c) == CornerTable::kNone;
      if (is_boundary || table_.names_inner_edge(c)) consider(table_.vertex(c), table_.head(c));
    }
  }

  [[nodiscard]] bool is_current(const Candidate& edge) const {
    return changes_[edge.a] == edge.changes_of_a && changes_[edge.b] == edge.changes_of_b;
  }

  [[nodiscard]] Quadric merged(std::uint32_t a, std::uint32_t b, const Vec3& origin) const {
    return quadrics_[a].seen_from(origin - at(a)) + quadrics_[b].seen_from(origin - at(b));
  }

  void consider(std::uint32_t a, std::uint32_t b) {
    if (is_kept(a) || is_kept(b)) return;
    if (a > b) std::swap(a, b);
    const Vec3 middle = 0.5 * (at(a) + at(b)), edge = at(b) - at(a);
    const double length2 = glm::dot(edge, edge);
    const Quadric planes = merged(a, b, middle);
    if (!(planes.weight > 0.0)) return;
    Vec3 place = best_place(planes);
    if (glm::dot(place, place) > length2) place = Vec3(0.0);
    const double off = planes.at(place);
    const double tolerance = options_.tolerance;
    if (tolerance > 0.0 && off > tolerance * tolerance * planes.weight) return;
    const std::optional<double> angle = smallest_angle_after(a, b, middle + place);
    if (!angle) return;
    const double worse = std::max(1.0, kGoodAngle / *angle);
    const double cost = worse * worse * (off + kHardlyOff * kHardlyOff * planes.weight * length2);
    queue_.push({cost, a, b, changes_[a], changes_[b], middle + place});
  }

  /// Nothing where a face would turn or get too small an angle.
  [[nodiscard]] std::optional<double> smallest_angle_after(std::uint32_t a, std::uint32_t b,
                                                           const Vec3& place) const {
    double least = 1.0;
    for (const auto& [v, other] : {std::pair(a, b), std::pair(b, a)}) {
      table_.for_each_corner(v, [&, v = v, other = other](std::uint32_t c) {
        const std::uint32_t p = table_.head(c), q = table_.apex(c);
        if (p == other || q == other || least == 0.0) return;
        const bool keeps_side = has_cosine(area_vector(at(v), at(p), at(q)),
                                           area_vector(place, at(p), at(q)), kMostTurn);
        least = std::min(least, keeps_side ? sine_of_smallest_angle(place, at(p), at(q)) : 0.0);
      });
    }
    if (least < smallest_angle_) return std::nullopt;
    return least;
  }

  /// The half-edge that may be collapsed; kNone if neither.
  [[nodiscard]] std::uint32_t collapsible(std::uint32_t a, std::uint32_t b) const {
    std::uint32_t found = CornerTable::kNone;
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
      table_.for_each_corner(from, [&, to = to](std::uint32_t c) {
        if (table_.head(c) != to) return;
        if (table_.is_collapse_ok(c) || table_.is_boundary_collapse_ok(c)) found = c;
      });
    }
    return found;
  }

  bool collapse(const Candidate& edge) {
    const std::uint32_t corner = collapsible(edge.a, edge.b);
    if (corner == CornerTable::kNone || !smallest_angle_after(edge.a, edge.b, edge.place))
      return false;
    const std::uint32_t kept = table_.head(corner);
    quadrics_[kept] = merged(edge.a, edge.b, edge.place);
    if (table_.across(corner) == CornerTable::kNone) {
      table_.collapse_boundary(corner);
      faces_ -= 1;
    } else {
      table_.collapse(corner);
      faces_ -= 2;
    }
    positions_[kept] = edge.place;
    ++changes_[edge.a];
    ++changes_[edge.b];
    table_.for_each_neighbor(kept, [&](std::uint32_t v) { consider(kept, v); });
    table_.for_each_corner(  // what was no good before may be now
        kept, [&](std::uint32_t c) { consider(table_.head(c), table_.apex(c)); });
    return true;
  }

  std::vector<Vec3>& positions_;
  CoarsenOptions options_;
  CornerTable table_;
  std::size_t faces_;
  std::vector<Quadric> quadrics_;
  std::vector<std::uint32_t> changes_;  ///< of each vertex
  double smallest_angle_ = 0.0;
  std::priority_queue<Candidate, std::vector<Candidate>, ComesLater> queue_;
};

}  // namespace

std::size_t coarsen(TriangleMesh& mesh, const CoarsenOptions& options, const Progress& progress) {
  Coarsener coarsener(mesh, options);
  const std::size_t count = coarsener.run(progress);
  mesh.triangles = coarsener.triangles();
  return count;
}

}  // namespace rangezip
