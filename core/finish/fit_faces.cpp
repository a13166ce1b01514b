#include "core/finish/fit_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "core/base/parallel.h"
#include "core/finish/corner_table.h"
#include "core/finish/edge_changes.h"
#include "core/finish/points_on_faces.h"
#include "core/finish/triangle_shape.h"
#include "core/finish/vertex_geometry.h"

namespace rangezip {
namespace {

// Angles as cosines.
constexpr int kRounds = 4;      // at least
constexpr int kMostRounds = 8;  // if the median of the angles is not met before
constexpr int kSweeps = 3;      // of solving: the rounds go on with what is left
constexpr double kMostTurn = 0.5;
constexpr double kSharpest = 0.5;     // edge that may arise
constexpr double kTurnGain = 0.995;   // of the squared distances: equal ones would turn to and fro
constexpr double kAngleGain = 0.05;   // sine: by so much better an angle is worth some distance
constexpr double kTurnSlack = 0.004;  // of the reach: that distance, at first
constexpr std::array kShares{1.0, 0.5, 0.25};  // of the way of a vertex, the first that may be
constexpr double kHoldAlways = 0.001;          // in points: where there are none
/// In points at each corner of a face: in what direction its points do not tell, its plane stays.
constexpr double kPlaneHold = 0.1;
/// Faces with fewer points turn their edge for the sake of angles only where they differ by less
/// than 10 degrees: no point would tell of an edge of the surface.
constexpr std::size_t kFewPoints = 4;
constexpr double kFlat = 0.985;
constexpr double kSmooth = 0.7;      // 45 degrees, from the normal of a vertex to its faces
constexpr double kRelaxStep = 0.55;  // towards the middle of the faces, that is held on to
constexpr double kMoreHold = 1.65;   // in the next round, if angles are too small
constexpr double kMoreSlack = 2.0;   // the same
/// Of the reach: points nearer than this are no outliers. Farther ones are, if fewer than one in
/// eight points on a face and its neighbours, at least six, are half as far on the same side.
constexpr double kNoOutlier = 0.1;
constexpr std::size_t kMinOthers = 6;
constexpr std::size_t kOthersPerFellow = 8;
constexpr double kHalfAsFar = 0.5;
constexpr std::size_t kPerBlock = 1024;

/// The normal equations of the points on a face for how far its plane moves at each corner.
struct FaceSums {
  Vec3 normal{0.0};
  std::array<std::array<double, 3>, 3> products{};  ///< of the barycentric coordinates
  std::array<double, 3> right{};                    ///< times the distances
};

class Fitter {
 public:
  Fitter(TriangleMesh& mesh, std::vector<Vec3> points, const FitFacesOptions& options)
      : positions_(mesh.positions),
        options_(options),
        hold_(options.hold),
        slack_(kTurnSlack * options.reach),
        table_(mesh.triangles, mesh.positions.size()),
        points_(mesh, table_, std::move(points), options.reach) {}

  void run(const Progress& progress) {
    bool is_median_met = true;
    for (int round = 0; round < kRounds || (round < kMostRounds && !is_median_met); ++round) {
      progress.check_stop();
      if (round > 0) points_.follow(table_, positions_);
      if (round > 0 && turn_edges() > 0) points_.follow(table_, positions_);
      sum_faces();
      hold_vertices();
      prepare_vertices();
      for (int sweep = 0; sweep < kSweeps; ++sweep)
        solve_vertices();
      move_vertices();
      is_median_met =
          options_.median_angle == 0.0 || median_of_smallest_angles() >= options_.median_angle;
      if (is_median_met) continue;
      hold_ *= kMoreHold;
      slack_ *= kMoreSlack;
    }
  }
  [[nodiscard]] std::vector<Triangle> triangles() const { return table_.triangles(); }

 private:
  [[nodiscard]] const Vec3& at(std::uint32_t vertex) const { return positions_[vertex]; }
  [[nodiscard]] double squared_distance(std::uint32_t a, std::uint32_t b, std::uint32_t c,
                                        const Vec3& point) const {
    return squared_distance_to_triangle(point, at(a), at(b), at(c));
  }

  /// Where that brings the faces nearer to their points, or angles grow and they stay as near. Of
  /// neighbouring edges only one turns.
  std::size_t turn_edges() {
    std::size_t count = 0;
    std::vector<std::uint8_t> is_new(table_.face_count(), 0);
    for (std::uint32_t c = 0; c < table_.corner_count(); ++c) {
      if (!table_.names_inner_edge(c)) continue;
      const std::uint32_t left = c / 3, right = table_.across(c) / 3;
      if (is_new[left] != 0 || is_new[right] != 0) continue;
      if (!may_turn(c) || !is_better_turned(c)) continue;
      table_.flip(c);
      is_new[left] = is_new[right] = 1;
      ++count;
    }
    return count;
  }

  [[nodiscard]] bool may_turn(std::uint32_t corner) const {
    const Diamond d(table_, corner);
    const double angle = angle_after_flip(positions_, d);
    if (angle < options_.small_angle && angle < angle_before_flip(positions_, d)) return false;
    const DiamondAreas areas(positions_, d);
    return has_cosine(areas.new_a, areas.new_b, kSharpest) && table_.is_flip_ok(corner);
  }

  [[nodiscard]] bool is_better_turned(std::uint32_t corner) const {
    const Diamond d(table_, corner);
    double before = 0.0, after = 0.0;
    std::size_t count = 0;
    for (const std::uint32_t face : {corner / 3, table_.across(corner) / 3}) {
      const Triangle t = table_.triangle(face);
      for (const std::uint32_t i : points_.of_face(face)) {
        const Vec3& p = points_.point(i);
        before += squared_distance(t[0], t[1], t[2], p);
        after += std::min(squared_distance(d.a, d.y, d.x, p), squared_distance(d.b, d.x, d.y, p));
        ++count;
      }
    }
    const double slack = static_cast<double>(count) * slack_ * slack_;
    const double gain = angle_after_flip(positions_, d) - angle_before_flip(positions_, d);
    if (gain > kAngleGain) {
      const DiamondAreas areas(positions_, d);
      const bool is_told = count >= kFewPoints || has_cosine(areas.old_x, areas.old_y, kFlat);
      return is_told && after <= before + slack;
    }
    return after < kTurnGain * before - (gain < -kAngleGain ? slack : 0.0);
  }

  void sum_faces() {
    sums_.assign(table_.face_count(), {});
    parallel_for(sums_.size(), kPerBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t f = begin; f < end; ++f)
        sums_[f] = sums_of(static_cast<std::uint32_t>(f));
    });
  }

  [[nodiscard]] FaceSums sums_of(std::uint32_t face) const {
    FaceSums sums;
    const Triangle t = table_.triangle(face);
    const Vec3 &a = at(t[0]), &b = at(t[1]), &c = at(t[2]);
    const Vec3 area = area_vector(a, b, c);
    if (!(glm::dot(area, area) > 0.0)) return sums;
    sums.normal = glm::normalize(area);
    for (std::size_t k = 0; k < 3; ++k)
      sums.products[k][k] = kPlaneHold;
    for (const std::uint32_t i : points_.of_face(face)) {
      const Vec3 foot = closest_point_on_triangle(points_.point(i), a, b, c);
      const std::array<double, 3> share = barycentric(foot, a, b, c);
      const double distance = glm::dot(sums.normal, points_.point(i) - foot);
      if (std::abs(distance) > kNoOutlier * options_.reach && is_outlier(face, distance)) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        sums.right[k] += share[k] * distance;
        for (std::size_t l = 0; l < 3; ++l)
          sums.products[k][l] += share[k] * share[l];
      }
    }
    return sums;
  }

  /// Whether hardly any other point on the face or a neighbour is as far from it.
  [[nodiscard]] bool is_outlier(std::uint32_t face, double distance) const {
    std::size_t others = 0, fellows = 0;
    const auto count_on = [&](std::uint32_t f) {
      const Triangle t = table_.triangle(f);
      const Vec3 normal = unit_or_z(face_area_vector(table_, positions_, f));
      for (const std::uint32_t i : points_.of_face(f)) {
        const double of_other = glm::dot(normal, points_.point(i) - at(t[0]));
        if (of_other / distance >= kHalfAsFar) ++fellows;
        ++others;
      }
    };
    count_on(face);
    for (std::uint32_t c = 3 * face; c < 3 * face + 3; ++c) {
      if (const std::uint32_t across = table_.across(c); across != CornerTable::kNone)
        count_on(across / 3);
    }
    --others;  // the point itself
    --fellows;
    return others >= kMinOthers && kOthersPerFellow * fellows < others;
  }

  /// Where each vertex would be without points, and how strongly it is held there.
  void hold_vertices() {
    rests_.assign(positions_.size(), Vec3(0.0));
    holds_.assign(positions_.size(), kHoldAlways);
    parallel_for(positions_.size(), kPerBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const auto v = static_cast<std::uint32_t>(i);
        if (table_.is_boundary(v)) continue;
        rests_[v] = kRelaxStep * way_to_middle(v);
        table_.for_each_corner(
            v, [&](std::uint32_t c) { holds_[v] += hold_ * sums_[c / 3].products[c % 3][c % 3]; });
      }
    });
  }

  /// Of the faces around a vertex, within its tangent plane; none on an edge of the surface.
  [[nodiscard]] Vec3 way_to_middle(std::uint32_t v) const {
    Vec3 sum{0.0}, normal{0.0};
    double weight = 0.0;
    table_.for_each_corner(v, [&](std::uint32_t c) {
      const Vec3 area = face_area_vector(table_, positions_, c / 3);
      const double size = glm::length(area);
      sum += size / 3.0 * (at(table_.head(c)) + at(table_.apex(c)) - 2.0 * at(v));
      normal += area;
      weight += size;
    });
    if (!(weight > 0.0)) return Vec3(0.0);
    normal = unit_or_z(normal);
    bool is_smooth = true;
    table_.for_each_corner(v, [&](std::uint32_t c) {
      const Vec3 area = face_area_vector(table_, positions_, c / 3);
      is_smooth = is_smooth && has_cosine(area, normal, kSmooth);
    });
    if (!is_smooth) return Vec3(0.0);
    const Vec3 way = sum / weight;
    return way - glm::dot(way, normal) * normal;
  }

  /// What of a vertex's equations stays the same while others move.
  void prepare_vertices() {
    shifts_.assign(positions_.size(), Vec3(0.0));
    inverses_.assign(positions_.size(), Mat3(0.0));
    rights_.assign(positions_.size(), Vec3(0.0));
    parallel_for(positions_.size(), kPerBlock, [&](std::size_t begin, std::size_t end) {
      for (auto v = static_cast<std::uint32_t>(begin); v < end; ++v) {
        if (!table_.is_boundary(v)) prepare_vertex(v);
      }
    });
  }

  void prepare_vertex(std::uint32_t v) {
    Mat3 products(holds_[v]);
    rights_[v] = holds_[v] * rests_[v];
    table_.for_each_corner(v, [&](std::uint32_t c) {
      const FaceSums& sums = sums_[c / 3];
      rights_[v] += sums.right[c % 3] * sums.normal;
      products += sums.products[c % 3][c % 3] * glm::outerProduct(sums.normal, sums.normal);
    });
    inverses_[v] = glm::inverse(products);  // holds are positive: so is its determinant
  }

  /// Each vertex in turn to where it is best, the others where they are, as in the method of Gauss
  /// and Seidel.
  void solve_vertices() {
    for (std::uint32_t v = 0; v < positions_.size(); ++v) {
      if (!table_.is_boundary(v)) shifts_[v] = best_shift(v);
    }
  }

  [[nodiscard]] Vec3 best_shift(std::uint32_t v) const {
    Vec3 right = rights_[v];
    table_.for_each_corner(v, [&](std::uint32_t c) {
      const FaceSums& sums = sums_[c / 3];
      const std::array<double, 3>& with = sums.products[c % 3];
      const double others = with[(c + 1) % 3] * glm::dot(sums.normal, shifts_[table_.head(c)]) +
                            with[(c + 2) % 3] * glm::dot(sums.normal, shifts_[table_.apex(c)]);
      right -= others * sums.normal;
    });
    return inverses_[v] * right;
  }

  void move_vertices() {
    for (std::uint32_t v = 0; v < positions_.size(); ++v) {
      if (table_.is_boundary(v)) continue;
      for (const double share : kShares) {
        const Vec3 target = at(v) + share * shifts_[v];
        if (!keeps_faces(v, target)) continue;
        positions_[v] = target;
        break;
      }
    }
  }

  [[nodiscard]] bool keeps_faces(std::uint32_t v, const Vec3& target) const {
    bool ok = true;
    table_.for_each_corner(v, [&](std::uint32_t c) {
      if (!ok) return;
      const Vec3 &p = at(table_.head(c)), &q = at(table_.apex(c));
      const double angle = sine_of_smallest_angle(target, p, q);
      ok = (angle >= options_.small_angle || angle >= sine_of_smallest_angle(at(v), p, q)) &&
           has_cosine(area_vector(at(v), p, q), area_vector(target, p, q), kMostTurn);
    });
    return ok;
  }

  /// As a sine.
  [[nodiscard]] double median_of_smallest_angles() const {
    std::vector<double> sines(table_.face_count());
    parallel_for(sines.size(), kPerBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t f = begin; f < end; ++f) {
        const Triangle t = table_.triangle(static_cast<std::uint32_t>(f));
        sines[f] = sine_of_smallest_angle(at(t[0]), at(t[1]), at(t[2]));
      }
    });
    const auto middle = sines.begin() + static_cast<std::ptrdiff_t>(sines.size() / 2);
    std::nth_element(sines.begin(), middle, sines.end());
    return *middle;
  }

  std::vector<Vec3>& positions_;
  FitFacesOptions options_;
  double hold_;   ///< that of this round
  double slack_;  ///< of a point's distance, in this round, where angles grow; model units
  CornerTable table_;
  PointsOnFaces points_;
  std::vector<FaceSums> sums_;
  std::vector<Vec3> rests_;     ///< of each vertex, relative to it
  std::vector<double> holds_;   ///< in points
  std::vector<Mat3> inverses_;  ///< of a vertex's own equations
  std::vector<Vec3> rights_;    ///< their right sides, but for what the others' shifts do
  std::vector<Vec3> shifts_;
};

}  // namespace

void fit_faces(TriangleMesh& mesh, std::vector<Vec3> points, const FitFacesOptions& options,
               const Progress& progress) {
  if (points.empty() || mesh.triangles.empty()) return;
  Fitter fitter(mesh, std::move(points), options);
  fitter.run(progress);
  mesh.triangles = fitter.triangles();
}

}  // namespace rangezip
