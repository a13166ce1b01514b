#include "core/finish/advance_front.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <numeric>
#include <optional>
#include <queue>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "core/base/cubes.h"
#include "core/finish/crossing_guard.h"
#include "core/finish/triangle_shape.h"
#include "core/mesh/edge_map.h"

namespace rangezip {
namespace {

/// Of the greatest radius: that of faces which bend by more than kFlat.
constexpr double kBentShare = 7.0 / 9.0;
/// Cosines: between a face and the one that it goes on from; and the faces around a vertex.
constexpr double kFlat = 0.7;
constexpr double kMinTurn = -0.1;
constexpr double kMinTurnAtVertex = -0.3;
constexpr double kNeedle = 0.1;  ///< sine of a smallest angle
/// In h, for each unit of cosine: how much farther a point may lie than one that bends more.
constexpr double kBendCost = 1.0;
/// In radii of 1 h, when faces of several edges compete: what is flat comes first.
constexpr double kBendDelay = 2.0;
constexpr double kGuardCube = 1.5;           ///< in h
constexpr int kMostAround = 60;              ///< edges, of what is closed
constexpr double kReach = 2.0;               ///< in h, of points: border vertices that are joined
constexpr std::size_t kFacesPerLook = 4096;  ///< between looks at whether to stop
constexpr std::uint32_t kNone = EdgeMap::kNone;

/// A few numbers for each cube of a grid.
class CubeLists {
 public:
  /// @param cubes that numbers may be in, any number of times
  CubeLists(std::vector<Cube> cubes, double side) : cubes_(std::move(cubes)), side_(side) {
    sort_cubes(cubes_);
    lists_.resize(cubes_.size());
  }

  void add(const Vec3& place, std::uint32_t number) {
    lists_[find_cube(cubes_, cube_of(place, side_))].push_back(number);
  }

  /// Those in the cube of a place, and in the cubes that touch it.
  template <class Visit>
  void for_each_around(const Vec3& place, const Visit& visit) const {
    for_each_cube_around(cubes_, cube_of(place, side_), [&](std::size_t cube) {
      for (const std::uint32_t number : lists_[cube])
        visit(number);
    });
  }

 private:
  std::vector<Cube> cubes_;
  double side_;
  std::vector<std::vector<std::uint32_t>> lists_;
};

std::vector<Cube> cubes_of(std::span<const Vec3> points, double side) {
  std::vector<Cube> cubes;
  cubes.reserve(points.size());
  for (const Vec3& p : points)
    cubes.push_back(cube_of(p, side));
  return cubes;
}

/// Whether one of the numbered places is within `radius`, a cube's side at most.
bool has_near(const CubeLists& lists, const std::vector<Vec3>& places, const Vec3& p,
              double radius) {
  bool found = false;
  lists.for_each_around(p, [&](std::uint32_t i) {
    found = found || glm::dot(places[i] - p, places[i] - p) < radius * radius;
  });
  return found;
}

/// The first of all that are nearer to each other than `distance`.
std::vector<Vec3> points_apart(std::span<const Vec3> points, double distance) {
  CubeLists lists(cubes_of(points, distance), distance);
  std::vector<Vec3> apart;
  for (const Vec3& p : points) {
    if (has_near(lists, apart, p, distance)) continue;
    lists.add(p, static_cast<std::uint32_t>(apart.size()));
    apart.push_back(p);
  }
  return apart;
}

enum class Topology : std::uint8_t {
  changes,  ///< fronts are joined to whatever they meet
  stays,    ///< to themselves
};

/// A face that might go on from a border edge.
struct Step {
  double cost = 0.0;  ///< the lowest comes first
  std::uint32_t from = 0, to = 0, tip = 0;

  friend bool operator>(const Step& p, const Step& q) {
    return std::tie(p.cost, p.from, p.to, p.tip) > std::tie(q.cost, q.from, q.to, q.tip);
  }
};

class Front {
 public:
  /// @param places of which the border is joined, besides the points
  /// @param topology whether a front meets others than itself
  Front(TriangleMesh& mesh, std::span<const Vec3> points, std::span<const Vec3> places,
        const AdvanceFrontOptions& options, Topology topology)
      : mesh_(mesh),
        h_(options.pixel_size),
        max_radius_(options.max_radius * h_),
        topology_(topology),
        votes_(options.votes),
        edges_(3 * mesh.triangles.size()),
        guard_(mesh, kGuardCube * h_) {
    const std::vector<Vec3> apart = points_apart(points, options.apart * h_);
    const auto old_vertices = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), apart.begin(), apart.end());
    if (!mesh.sources.empty()) mesh.sources.resize(mesh.positions.size());
    area_around_.assign(mesh.positions.size(), Vec3(0.0));
    open_edges_.assign(mesh.positions.size(), 0);
    for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f)
      enter(f);
    choose_tips(apart, places, old_vertices);
  }

  void run(const Progress& progress) {
    for (std::uint32_t f = 0; f < mesh_.triangles.size(); ++f)
      look_beyond(f);
    for (std::size_t taken = 1; !steps_.empty(); ++taken) {
      if (taken % kFacesPerLook == 0) progress.check_stop();
      const Step step = steps_.top();
      steps_.pop();
      if (!is_open(step.from, step.to)) continue;
      const Triangle beyond{step.to, step.from, step.tip};
      if (!may_take(step.from, step.to, step.tip) || guard_.would_cross(beyond) ||
          looks_back(beyond)) {
        refused_.insert(beyond);
        look_beyond(step.from, step.to);
        continue;
      }
      const auto face = static_cast<std::uint32_t>(mesh_.triangles.size());
      mesh_.triangles.push_back(beyond);
      guard_.add(face);
      enter(face);
      look_beyond(face);
    }
  }

 private:
  [[nodiscard]] const Vec3& at(std::uint32_t v) const { return mesh_.positions[v]; }

  /// The points, and the vertices of the border near them and near the places.
  void choose_tips(const std::vector<Vec3>& points, std::span<const Vec3> places,
                   std::uint32_t old_vertices) {
    const double reach = kReach * h_;
    std::vector<Vec3> wanted = points;
    wanted.insert(wanted.end(), places.begin(), places.end());
    CubeLists lists(cubes_of(wanted, reach), reach);
    for (std::uint32_t i = 0; i < wanted.size(); ++i)
      lists.add(wanted[i], i);
    std::vector<Vec3> positions = points;
    std::vector<std::uint32_t> tips(points.size());
    std::iota(tips.begin(), tips.end(), old_vertices);
    for (std::uint32_t v = 0; v < old_vertices; ++v) {
      if (open_edges_[v] == 0 || !has_near(lists, wanted, at(v), reach)) continue;
      tips.push_back(v);
      positions.push_back(at(v));
    }
    const double side = 2.0 * max_radius_;
    near_ = CubeLists(cubes_of(positions, side), side);
    is_tip_.assign(mesh_.positions.size(), 0);
    for (const std::uint32_t v : tips) {
      near_.add(at(v), v);
      is_tip_[v] = 1;
    }
  }

  void enter(std::uint32_t f) {
    const Triangle& t = mesh_.triangles[f];
    const Vec3 area = area_vector(at(t[0]), at(t[1]), at(t[2]));
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      edges_.insert(a, b, f);
      const int change = edges_.find(b, a) == kNone ? 1 : -1;
      open_edges_[a] += change;
      open_edges_[b] += change;
      area_around_[a] += area;
    }
  }

  [[nodiscard]] bool is_open(std::uint32_t a, std::uint32_t b) const {
    return edges_.find(a, b) != kNone && edges_.find(b, a) == kNone;
  }
  [[nodiscard]] bool is_free(std::uint32_t v) const { return area_around_[v] == Vec3(0.0); }

  /// Whether a face beyond edge (a, b) to v repeats no directed edge, and v is not inside.
  [[nodiscard]] bool may_take(std::uint32_t a, std::uint32_t b, std::uint32_t v) const {
    return (is_free(v) || open_edges_[v] > 0) && edges_.find(a, v) == kNone &&
           edges_.find(v, b) == kNone && (topology_ == Topology::changes || is_on_loop(a, b, v));
  }

  [[nodiscard]] bool looks_back(const Triangle& face) const {
    return votes_ != nullptr && votes_->look_out_of_back(mesh_.positions, face);
  }

  /// Whether a vertex is on the boundary loop of border edge (a, b), if that is short.
  [[nodiscard]] bool is_on_loop(std::uint32_t a, std::uint32_t b, std::uint32_t v) const {
    std::uint32_t from = a, to = b;
    for (int i = 0; i < kMostAround; ++i) {
      if (to == v) return true;
      std::tie(from, to) = border_edge_after(from, to);
      if (from == a && to == b) return false;
    }
    return false;
  }

  [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> border_edge_after(std::uint32_t a,
                                                                          std::uint32_t b) const {
    for (std::uint32_t face = edges_.find(a, b);;) {
      const Triangle& t = mesh_.triangles[face];
      const auto at_b = static_cast<std::size_t>(std::find(t.begin(), t.end(), b) - t.begin());
      const std::uint32_t next = t[(at_b + 1) % 3];
      face = edges_.find(next, b);
      if (face == kNone) return {b, next};
    }
  }

  void look_beyond(std::uint32_t face) {
    const Triangle t = mesh_.triangles[face];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      if (is_open(a, b) && (is_tip_[a] != 0 || is_tip_[b] != 0)) look_beyond(a, b);
    }
  }

  /// Notes the best face beyond a border edge, if there is one.
  void look_beyond(std::uint32_t a, std::uint32_t b) {
    std::optional<Step> best;
    double least = 0.0;
    const Triangle& face = mesh_.triangles[edges_.find(a, b)];
    near_.for_each_around(0.5 * (at(a) + at(b)), [&](std::uint32_t v) {
      if (v == face[0] || v == face[1] || v == face[2]) return;
      const std::optional<Beyond> beyond = face_beyond(a, b, v, face);
      if (!beyond || !may_take(a, b, v)) return;
      if (best && std::tie(beyond->value, v) >= std::tie(least, best->tip)) return;
      if (refused_.contains({b, a, v})) return;
      least = beyond->value;
      best = Step{beyond->cost, a, b, v};
    });
    if (best) steps_.push(*best);
  }

  /// Of a face beyond an edge: which of them is best, and when it comes.
  struct Beyond {
    double value = 0.0;
    double cost = 0.0;
  };

  [[nodiscard]] std::optional<Beyond> face_beyond(std::uint32_t a, std::uint32_t b, std::uint32_t v,
                                                  const Triangle& face) const {
    const Vec3 &pa = at(a), &pb = at(b), &p = at(v);
    const Vec3 area = area_vector(pb, pa, p);
    const double twice_area = glm::length(area);
    if (!(twice_area > 0.0) || sine_of_smallest_angle(pa, pb, p) < kNeedle) return std::nullopt;
    const double length = glm::length(pb - pa);
    const double radius = length * glm::length(p - pa) * glm::length(p - pb) / (2.0 * twice_area);
    const Vec3 before = area_vector(at(face[0]), at(face[1]), at(face[2]));
    const double turn = cosine(before, area);
    if (turn < kMinTurn || radius > (turn < kFlat ? kBentShare : 1.0) * max_radius_)
      return std::nullopt;
    if (!is_free(v) && cosine(area_around_[v], area) < kMinTurnAtVertex) return std::nullopt;
    const double cotangent = glm::dot(pa - p, pb - p) / twice_area;  // at v
    const double bend = 1.0 - turn;
    return Beyond{0.5 * length * cotangent + kBendCost * h_ * bend,
                  radius / h_ + kBendDelay * bend};
  }

  static double cosine(const Vec3& a, const Vec3& b) {
    const double lengths = glm::length(a) * glm::length(b);
    return lengths > 0.0 ? glm::dot(a, b) / lengths : -1.0;
  }

  TriangleMesh& mesh_;
  double h_;
  double max_radius_;  ///< model units
  Topology topology_;
  const VoteGrid* votes_;
  EdgeMap edges_;
  std::vector<Vec3> area_around_;     ///< of each vertex: sum over its faces; none: zero
  std::vector<int> open_edges_;       ///< of each vertex, without a face on one side
  std::vector<std::uint8_t> is_tip_;  ///< whether faces may come to a vertex
  CubeLists near_{{}, 1.0};           ///< the tips
  CrossingGuard guard_;
  std::set<Triangle> refused_;  ///< faces that were best once, but could not be made
  std::priority_queue<Step, std::vector<Step>, std::greater<>> steps_;
};

}  // namespace

std::size_t advance_front(TriangleMesh& mesh, std::span<const Vec3> points,
                          const AdvanceFrontOptions& options, const Progress& progress) {
  const std::size_t before = mesh.triangles.size();
  if (before == 0 || points.empty()) return 0;
  Front(mesh, points, {}, options, Topology::changes).run(progress);
  return mesh.triangles.size() - before;
}

std::size_t close_fronts(TriangleMesh& mesh, std::span<const Vec3> places,
                         const AdvanceFrontOptions& options, const Progress& progress) {
  const std::size_t before = mesh.triangles.size();
  Front(mesh, {}, places, options, Topology::stays).run(progress);
  return mesh.triangles.size() - before;
}

}  // namespace rangezip
