#include "core/finish/reach_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "core/finish/angle_defect.h"
#include "core/finish/corner_table.h"
#include "core/finish/edge_changes.h"
#include "core/finish/places_near.h"
#include "core/finish/points_on_faces.h"
#include "core/finish/triangle_shape.h"
#include "core/finish/unsupported_faces.h"
#include "core/finish/vertex_geometry.h"
#include "core/mesh/coverage.h"
#include "core/mesh/face_changes.h"
#include "core/mesh/self_intersection.h"

namespace rangezip {
namespace {

// Lengths are in h, angles as cosines, smallest angles as sines.
constexpr double kShort = 0.25;  ///< points farther than this from the mesh are to be reached
constexpr double kShortPerNoise = 3.0;
constexpr double kMostNoise = 0.125;
constexpr double kReach = 3.0;         ///< of rims that are short
constexpr double kAround = 2.0;        ///< of such points: those that tell whether a move is good
constexpr double kPart = 8.0;          ///< of such points: faces that may be met
constexpr double kHalf = 0.5;          ///< of the radius: cells of grids
constexpr double kCrease = 0.5;        ///< 60 degrees
constexpr std::size_t kMinPoints = 2;  ///< next to a vertex, to be reached
constexpr double kGain = 0.9;          ///< of the sum of squares, at most, after a move
constexpr double kSharp = 0.2;         ///< faces may not get so sharp
constexpr double kFold = -0.95;        ///< between neighbouring faces
constexpr double kLongEdge = 1.5;      ///< of the mean edge
constexpr double kOneSide = 0.9;       ///< between the faces of an edge that may turn
constexpr double kAngleGain = 0.005;
constexpr int kRounds = 10;
constexpr double kRough = 1.0;      ///< radians around a spike, at least
constexpr double kSmoother = 0.7;   ///< of them, at most, around a spike that was lowered
constexpr double kClearGain = 0.7;  ///< kGain of a move that may leave a spike
constexpr int kLowerings = 5;
constexpr std::array kHeights{0.75, 0.5, 0.25, 0.0};  ///< of a spike over its neighbours
constexpr std::array kShares{1.0, 0.5};               ///< of the way, the first that is good
constexpr std::uint32_t kNone = CornerTable::kNone;

/// The ends of creases.
std::vector<Vec3> sharp_vertices(const TriangleMesh& mesh) {
  const CornerTable table(mesh.triangles, mesh.positions.size());
  std::vector<std::uint8_t> is_sharp(mesh.positions.size(), 0);
  for (std::uint32_t c = 0; c < table.corner_count(); ++c) {
    if (!table.names_inner_edge(c)) continue;
    if (has_cosine(face_area_vector(table, mesh.positions, c / 3),
                   face_area_vector(table, mesh.positions, table.across(c) / 3), kCrease)) {
      continue;
    }
    is_sharp[table.vertex(c)] = is_sharp[table.head(c)] = 1;
  }
  std::vector<Vec3> sharp;
  for (std::uint32_t v = 0; v < is_sharp.size(); ++v) {
    if (is_sharp[v] != 0) sharp.push_back(mesh.positions[v]);
  }
  return sharp;
}

class Reacher {
 public:
  /// @param points that the mesh is to reach, and those around
  Reacher(TriangleMesh& mesh, std::vector<Vec3> points, const PointGrid& cloud, double too_short,
          const ReachPointsOptions& options, const Progress& progress)
      : positions_(mesh.positions),
        mesh_(mesh),
        cloud_(cloud),
        options_(options),
        progress_(progress),
        short_(too_short),
        table_(mesh.triangles, mesh.positions.size()),
        on_(mesh, table_, std::move(points), kReach * options.pixel_size),
        is_hopeless_(mesh.positions.size(), 0),
        is_moved_(mesh.positions.size(), 0) {}

  /// Vertices of a round.
  struct Moves {
    std::size_t tried = 0;  ///< next to them others were not, and may be in the next round
    std::size_t moved = 0;
  };

  Moves round() {
    progress_.check_stop();
    const TriangleMesh before = geometry_of(mesh_);
    std::vector<std::uint8_t> is_busy(positions_.size(), 0);
    std::vector<std::uint32_t> moved;
    for (const Candidate& candidate : find_candidates()) {
      const std::uint32_t v = candidate.vertex;
      if (is_busy[v] != 0) continue;
      if (!move(candidate)) {
        is_hopeless_[v] = 1;
        continue;
      }
      moved.push_back(v);
      for_each_around(v, [&](std::uint32_t w) { is_busy[w] = 1; });
    }
    const std::size_t tried = moved.size();
    take_back_crossing(before.positions, moved);
    for (const std::uint32_t v : moved) {
      is_moved_[v] = 1;
      for_each_around(v, [&](std::uint32_t w) { is_hopeless_[w] = 0; });
    }
    for (const std::uint32_t v : moved)
      split_long_edges(v);
    for (const std::uint32_t v : moved)
      turn_edges(v);
    mesh_.triangles = table_.triangles();
    on_.find_again(mesh_, table_, changes_since(before));
    return {.tried = tried, .moved = moved.size()};
  }

  /// Takes vertices that moved, and now stick out alone, back toward their neighbours where that
  /// costs little of what they gained.
  void lower_spikes() {
    for (int round = 0; round < kLowerings; ++round) {
      progress_.check_stop();
      const std::vector<std::uint32_t> spikes = find_spikes();
      if (spikes.empty()) return;
      const TriangleMesh before = geometry_of(mesh_);
      std::vector<std::uint32_t> lowered;
      for (const std::uint32_t v : spikes) {
        if (lower(v)) lowered.push_back(v);
      }
      take_back_crossing(before.positions, lowered);
      if (lowered.empty()) return;
      on_.find_again(mesh_, table_, changes_since(before));
    }
  }

 private:
  /// Of the vertices that moved; the roughest first.
  [[nodiscard]] std::vector<std::uint32_t> find_spikes() const {
    std::vector<std::pair<double, std::uint32_t>> spikes;
    for (std::uint32_t v = 0; v < is_moved_.size(); ++v) {
      if (is_moved_[v] == 0 || table_.is_boundary(v)) continue;
      const double rough = roughness_around(table_, positions_, v);
      if (rough > kRough) spikes.emplace_back(-rough, v);
    }
    std::sort(spikes.begin(), spikes.end());
    std::vector<std::uint32_t> sorted;
    sorted.reserve(spikes.size());
    for (const auto& [rough, v] : spikes)
      sorted.push_back(v);
    return sorted;
  }

  /// @return whether the vertex got smoother
  bool lower(std::uint32_t v) {
    const double rough = roughness_around(table_, positions_, v);
    if (rough <= kRough) return false;  // since a neighbour was lowered
    const Vec3 place = at(v);
    const Vec3 foot = mean_of_neighbors(v);
    const std::vector<NearPoint> near = points_around(v);
    const double most_error = error_around(v, near) / kClearGain;
    const double sharpest = std::min(sharpest_around(v), kSharp);
    double least = kSmoother * rough;
    Vec3 best = place;
    for (const double height : kHeights) {
      positions_[v] = foot + height * (place - foot);
      const double now = roughness_around(table_, positions_, v);
      if (now >= least || sharpest_around(v) < sharpest || is_folded(v) ||
          error_around(v, near) > most_error) {
        continue;
      }
      best = at(v);
      least = now;
      if (now <= kRough) break;
    }
    positions_[v] = best;
    return best != place;
  }

  [[nodiscard]] Vec3 mean_of_neighbors(std::uint32_t v) const {
    Vec3 sum{0.0};
    double count = 0.0;
    table_.for_each_neighbor(v, [&](std::uint32_t w) {
      sum += at(w);
      count += 1.0;
    });
    return sum / count;
  }

  /// Flags faces that are not what they were; they keep their numbers, and others follow them.
  [[nodiscard]] std::vector<std::uint8_t> changes_since(const TriangleMesh& before) const {
    return flags_of(mesh_.triangles.size(), [&](std::size_t f) {
      const Triangle& t = mesh_.triangles[f];
      if (f >= before.triangles.size() || t != before.triangles[f]) return true;
      return std::any_of(t.begin(), t.end(),
                         [&](std::uint32_t v) { return at(v) != before.positions[v]; });
    });
  }

  /// A vertex next to points that are to be reached.
  struct Candidate {
    std::uint32_t vertex = kNone;
    Vec3 farthest{0.0};
    double distance2 = 0.0;
    std::size_t count = 0;
  };

  /// A point near a vertex, with its squared distance to what does not move with it.
  struct NearPoint {
    Vec3 place{0.0};
    double distance2 = 0.0;
  };

  [[nodiscard]] const Vec3& at(std::uint32_t vertex) const { return positions_[vertex]; }

  /// Visits a vertex and those within two edges, some more than once.
  template <class Visit>
  void for_each_around(std::uint32_t v, const Visit& visit) const {
    table_.for_each_neighbor(v, [&](std::uint32_t w) {
      visit(w);
      table_.for_each_neighbor(w, visit);
    });
  }

  /// Those of the farthest points first.
  [[nodiscard]] std::vector<Candidate> find_candidates() const {
    std::vector<Candidate> of_vertex(positions_.size());
    for (std::uint32_t f = 0; f < table_.face_count(); ++f) {
      for (const std::uint32_t index : on_.of_face(f)) {
        const Vec3& p = on_.point(index);
        const double distance2 = distance2_to(f, p);
        if (distance2 < short_ * short_) continue;
        const std::uint32_t v = nearest_corner(f, p);
        if (table_.is_boundary(v) || is_hopeless_[v] != 0) continue;
        Candidate& candidate = of_vertex[v];
        candidate.vertex = v;
        ++candidate.count;
        if (distance2 <= candidate.distance2) continue;
        candidate.distance2 = distance2;
        candidate.farthest = p;
      }
    }
    std::erase_if(of_vertex, [](const Candidate& c) { return c.count < kMinPoints; });
    std::stable_sort(of_vertex.begin(), of_vertex.end(),
                     [](const auto& a, const auto& b) { return a.distance2 > b.distance2; });
    return of_vertex;
  }

  [[nodiscard]] double distance2_to(std::uint32_t face, const Vec3& p) const {
    const Triangle t = table_.triangle(face);
    return squared_distance_to_triangle(p, at(t[0]), at(t[1]), at(t[2]));
  }

  [[nodiscard]] std::uint32_t nearest_corner(std::uint32_t face, const Vec3& p) const {
    const Triangle t = table_.triangle(face);
    return *std::min_element(t.begin(), t.end(), [&](std::uint32_t a, std::uint32_t b) {
      return glm::dot(at(a) - p, at(a) - p) < glm::dot(at(b) - p, at(b) - p);
    });
  }

  /// Moves a vertex if that is better. @return whether it has
  bool move(const Candidate& candidate) {
    const std::uint32_t v = candidate.vertex;
    const Vec3 place = at(v);
    const std::vector<NearPoint> near = points_around(v);
    const double error = error_around(v, near);
    const double sharpest = std::min(sharpest_around(v), kSharp);
    const int in_air = places_in_air(v);
    for (const double share : kShares) {
      positions_[v] = place + share * (candidate.farthest - place);
      if (sharpest_around(v) >= sharpest && !is_folded(v) &&
          error_around(v, near) <= kGain * error && places_in_air(v) <= in_air) {
        return true;
      }
    }
    positions_[v] = place;
    return false;
  }

  /// The points next to the faces around a vertex and its neighbours.
  [[nodiscard]] std::vector<NearPoint> points_around(std::uint32_t v) const {
    std::vector<std::uint32_t> moving, faces;
    table_.for_each_corner(v, [&](std::uint32_t c) { moving.push_back(c / 3); });
    table_.for_each_neighbor(v, [&](std::uint32_t w) {
      table_.for_each_corner(w, [&](std::uint32_t c) { faces.push_back(c / 3); });
    });
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    std::vector<NearPoint> near;
    for (const std::uint32_t f : faces) {
      for (const std::uint32_t index : on_.of_face(f))
        near.push_back({on_.point(index), std::numeric_limits<double>::infinity()});
    }
    std::erase_if(faces, [&](std::uint32_t f) {
      return std::find(moving.begin(), moving.end(), f) != moving.end();
    });
    for (NearPoint& point : near) {
      for (const std::uint32_t f : faces)
        point.distance2 = std::min(point.distance2, distance2_to(f, point.place));
    }
    return near;
  }

  /// Sum of the squared distances of points from the mesh.
  [[nodiscard]] double error_around(std::uint32_t v, const std::vector<NearPoint>& near) const {
    double sum = 0.0;
    for (const NearPoint& point : near) {
      double least = point.distance2;
      table_.for_each_corner(
          v, [&](std::uint32_t c) { least = std::min(least, distance2_to(c / 3, point.place)); });
      sum += least;
    }
    return sum;
  }

  [[nodiscard]] double sharpest_around(std::uint32_t v) const {
    double sharpest = 1.0;
    table_.for_each_corner(v, [&](std::uint32_t c) {
      sharpest =
          std::min(sharpest, sine_of_smallest_angle(at(v), at(table_.head(c)), at(table_.apex(c))));
    });
    return sharpest;
  }

  /// Whether two faces, of which one is around the vertex, lie back to back.
  [[nodiscard]] bool is_folded(std::uint32_t v) const {
    bool found = false;
    const auto look = [&](std::uint32_t c) {
      if (table_.across(c) == kNone) return;
      const Vec3 a = face_area_vector(table_, positions_, c / 3);
      const Vec3 b = face_area_vector(table_, positions_, table_.across(c) / 3);
      found = found || glm::dot(a, b) < kFold * glm::length(a) * glm::length(b);
    };
    table_.for_each_corner(v, [&](std::uint32_t c) {
      look(c);
      look(CornerTable::next(c));
    });
    return found;
  }

  /// Of the centroids and the middles of sides of the faces around.
  [[nodiscard]] int places_in_air(std::uint32_t v) const {
    int count = 0;
    table_.for_each_corner(v, [&](std::uint32_t c) {
      const Vec3 &p = at(v), &q = at(table_.head(c)), &r = at(table_.apex(c));
      for (const Vec3& place : {(p + q + r) / 3.0, 0.5 * (p + q), 0.5 * (q + r)})
        count += is_supported(cloud_, place, options_.pixel_size, kCloseSupport) ? 0 : 1;
    });
    return count;
  }

  /// Moves of vertices of faces that cross others, until none is left.
  void take_back_crossing(const std::vector<Vec3>& before, std::vector<std::uint32_t>& moved) {
    while (!moved.empty()) {
      std::vector<std::uint32_t> changed;
      for (const std::uint32_t v : moved)
        table_.for_each_corner(v, [&](std::uint32_t c) { changed.push_back(c / 3); });
      const auto crossing = self_intersections(mesh_, changed, {}, progress_);
      if (crossing.empty()) return;
      std::vector<std::uint8_t> crosses(positions_.size(), 0);
      for (const auto& [i, j] : crossing) {
        for (const std::uint32_t f : {i, j}) {
          for (const std::uint32_t v : table_.triangle(f))
            crosses[v] = 1;
        }
      }
      for (const std::uint32_t v : moved) {
        if (crosses[v] == 0) continue;
        positions_[v] = before[v];
        is_hopeless_[v] = 1;
      }
      std::erase_if(moved, [&](std::uint32_t v) { return crosses[v] != 0; });
    }
  }

  void split_long_edges(std::uint32_t v) {
    std::vector<std::uint32_t> far;
    table_.for_each_neighbor(v, [&](std::uint32_t w) {
      if (glm::length(at(w) - at(v)) > kLongEdge * options_.edge) far.push_back(w);
    });
    for (const std::uint32_t w : far) {
      const std::uint32_t corner = table_.half_edge(v, w);
      if (corner == kNone || table_.across(corner) == kNone) continue;
      table_.split_edge(corner);
      positions_.push_back(0.5 * (at(v) + at(w)));
      is_hopeless_.push_back(0);
      is_moved_.push_back(1);
    }
  }

  void turn_edges(std::uint32_t v) {
    std::vector<std::uint32_t> around{v};
    table_.for_each_neighbor(v, [&](std::uint32_t w) { around.push_back(w); });
    for (const std::uint32_t w : around)
      turn_worst_edge(w);
  }

  /// The one whose turn within a side makes the smallest angle grow most.
  void turn_worst_edge(std::uint32_t v) {
    std::uint32_t worst = kNone;
    double most = kAngleGain;
    table_.for_each_corner(v, [&](std::uint32_t c) {
      if (table_.across(c) == kNone) return;
      const Diamond d(table_, c);
      // At the end of the part the two may be neighbours outside of it.
      if (table_.is_boundary(d.x) || table_.is_boundary(d.y)) return;
      if (!is_flat(DiamondAreas(positions_, d), kOneSide)) return;
      const double gain = angle_after_flip(positions_, d) - angle_before_flip(positions_, d);
      if (gain <= most || !table_.is_flip_ok(c)) return;
      most = gain;
      worst = c;
    });
    if (worst != kNone) table_.flip(worst);
  }

  std::vector<Vec3>& positions_;
  TriangleMesh& mesh_;
  const PointGrid& cloud_;
  const ReachPointsOptions& options_;
  const Progress& progress_;
  double short_;
  CornerTable table_;
  PointsOnFaces on_;
  std::vector<std::uint8_t> is_hopeless_;  ///< vertices that have no good move as things are
  std::vector<std::uint8_t> is_moved_;     ///< or came when an edge of those was split
};

}  // namespace

std::size_t reach_points(TriangleMesh& mesh, const PointGrid& cloud,
                         const ReachPointsOptions& options, const Progress& progress) {
  const double h = options.pixel_size;
  if (cloud.empty() || mesh.empty() || options.noise > kMostNoise * h) return 0;
  const std::vector<Vec3> sharp = sharp_vertices(mesh);
  if (sharp.empty()) return 0;
  const double too_short = std::max(kShort * h, kShortPerNoise * options.noise);
  const std::vector<Vec3> missed = points_off(
      points_near(cloud, grid_of(sharp, kHalf * kReach * h), kReach * h), mesh, too_short);
  if (missed.size() < kMinPoints) return 0;
  FacePart part = part_near(mesh, grid_of(missed, kHalf * kPart * h), kPart * h);
  if (part.mesh.empty()) return 0;
  Reacher reacher(part.mesh, points_near(cloud, grid_of(missed, kHalf * kAround * h), kAround * h),
                  cloud, too_short, options, progress);
  std::size_t moves = 0;
  for (int round = 0; round < kRounds; ++round) {
    const auto [tried, moved] = reacher.round();
    if (tried == 0) break;
    moves += moved;
  }
  if (moves > 0) {
    reacher.lower_spikes();
    put_back(std::move(part), mesh);
  }
  return moves;
}

}  // namespace rangezip
