#include "core/finish/extend_border.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/base/parallel.h"
#include "core/finish/corner_table.h"
#include "core/finish/local_plane.h"
#include "core/finish/self_intersection.h"
#include "core/finish/triangle_shape.h"

namespace rangezip {
namespace {

// Lengths are in h, angles as cosines, and smallest angles as sines.
constexpr double kReach = 1.0;        // points farther from the border than this do not count
constexpr double kMaxHeight = 0.5;    // over the face's plane; higher ones are another sheet
constexpr double kNegligible = 0.02;  // beyond the border; not worth a move
constexpr double kSupportRadius = 0.8;
constexpr int kMinSupport = 2;      // points in that radius, with the one they support
constexpr double kFitRadius = 1.2;  // of the plane at the new place
constexpr int kMinFitPoints = 6;
constexpr double kFitMinCosine = 0.8;  // between the fitted plane and the mesh
constexpr double kMaxLift = 0.3;       // onto that plane
constexpr double kMaxTurn = 0.5;       // 60 degrees
constexpr double kSliver = 0.1;
constexpr double kMinForward = 0.5;  // 60 degrees between where a vertex and its edge may move
constexpr std::size_t kVerticesPerBlock = 64;
constexpr double kSampleCell = 0.7;  // of the grid of mesh samples
// Vertices of crossing faces go half the way back so often, then all the way, and after the last
// trial all vertices do.
constexpr int kHalvings = 3;
constexpr int kMaxTrials = 8;

/// Vertices and centroids of faces: every place of the mesh is near one of them.
PointGrid samples_of(const TriangleMesh& mesh, double h) {
  std::vector<Vec3> samples = mesh.positions;
  samples.reserve(mesh.positions.size() + mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    samples.push_back((mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3.0);
  }
  return PointGrid(samples, bounds_of(mesh), kSampleCell * h);
}

/// A border edge as seen from one of its ends.
struct BorderEdge {
  Vec3 start{0.0};  ///< the end in question
  Vec3 along{0.0};  ///< to the other end
  Vec3 normal{0.0};
  Vec3 outward{0.0};  ///< unit, in the plane of the face
};

class Extender {
 public:
  Extender(TriangleMesh& mesh, const CornerTable& table, const PointGrid& cloud, double pixel_size)
      : mesh_(mesh), table_(table), cloud_(cloud), h_(pixel_size) {
    for (std::uint32_t v = 0; v < table.vertex_count(); ++v) {
      if (table.corner_of(v) != CornerTable::kNone && table.is_boundary(v)) border_.push_back(v);
    }
  }

  void round(ExtendBorderReport& report) {
    before_.clear();
    for (const std::uint32_t v : border_)
      before_.push_back(at(v));
    const PointGrid samples = samples_of(mesh_, h_);
    std::vector<Vec3> targets(border_.size());
    parallel_for(border_.size(), kVerticesPerBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        targets[i] = target_of(border_[i], samples);
    });
    for (std::size_t i = 0; i < border_.size(); ++i)
      move(border_[i], targets[i]);
    report.reverted_moves += uncross();
    for (std::size_t i = 0; i < border_.size(); ++i)
      report.moves += at(border_[i]) != before_[i] ? 1 : 0;
  }

 private:
  [[nodiscard]] const Vec3& at(std::uint32_t vertex) const { return mesh_.positions[vertex]; }

  /// @param corner of a half-edge at the border
  [[nodiscard]] BorderEdge edge_at(std::uint32_t corner, bool is_from_head) const {
    const Vec3& a = at(table_.vertex(corner));
    const Vec3& b = at(table_.head(corner));
    BorderEdge edge;
    edge.normal = area_vector(a, b, at(table_.apex(corner)));
    const double area = glm::length(edge.normal);
    const Vec3 outward = glm::cross(b - a, edge.normal);
    const double length = glm::length(outward);
    if (!(area > 0.0) || !(length > 0.0)) return {};
    edge.normal /= area;
    edge.outward = outward / length;
    edge.start = is_from_head ? b : a;
    edge.along = is_from_head ? a - b : b - a;
    return edge;
  }

  [[nodiscard]] Vec3 target_of(std::uint32_t v, const PointGrid& samples) const {
    const std::uint32_t leaving = table_.corner_of(v);
    std::uint32_t last = leaving;
    table_.for_each_corner(v, [&](std::uint32_t c) { last = c; });
    const BorderEdge edges[2]{edge_at(leaving, false), edge_at(CornerTable::previous(last), true)};
    const Vec3 sum = edges[0].outward + edges[1].outward;
    const double length = glm::length(sum);
    if (!(length > 0.0)) return at(v);
    const Vec3 forward = sum / length;
    double step = 0.0;
    for (const BorderEdge& edge : edges)
      step = std::max(step, step_past(edge, forward, samples));
    if (!(step > 0.0)) return at(v);
    const Vec3 target = at(v) + std::min(step, kReach * h_) * forward;
    const Vec3 normal_sum = edges[0].normal + edges[1].normal;
    return on_cloud(target, normal_sum / glm::length(normal_sum));
  }

  /// How far the edge's start has to move for the edge to pass all points beyond it, if the other
  /// end does its share.
  [[nodiscard]] double step_past(const BorderEdge& edge, const Vec3& forward,
                                 const PointGrid& samples) const {
    const double squared_length = glm::dot(edge.along, edge.along);
    const double cosine = glm::dot(forward, edge.outward);
    if (!(squared_length > 0.0) || !(cosine > kMinForward)) return 0.0;
    const Vec3 middle = edge.start + 0.5 * edge.along;
    const double radius = kReach * h_ + 0.5 * std::sqrt(squared_length);
    double step = 0.0;
    cloud_.for_each_near(middle, radius, [&](const Vec3& d) {
      const Vec3 from_start = middle + d - edge.start;
      const double t = std::clamp(glm::dot(from_start, edge.along) / squared_length, 0.0, 1.0);
      const Vec3 offset = from_start - t * edge.along;
      const double over = glm::dot(offset, edge.outward);
      if (over <= kNegligible * h_ || glm::dot(offset, offset) > kReach * kReach * h_ * h_) return;
      if (std::abs(glm::dot(offset, edge.normal)) > kMaxHeight * h_) return;
      // Both ends moving by their share, in proportion to how near the point is, do least; but
      // neither has to go past the point.
      const double share = 1.0 - t;
      const double wanted = std::min(over * share / ((share * share + t * t) * cosine),
                                     glm::dot(from_start, forward));
      if (wanted <= step) return;
      if (is_supported(edge.start + from_start) &&
          is_nearest(edge.start + from_start, glm::dot(offset, offset), samples)) {
        step = wanted;
      }
    });
    return step;
  }

  [[nodiscard]] bool is_supported(const Vec3& p) const {
    int count = 0;
    cloud_.for_each_near(p, kSupportRadius * h_, [&](const Vec3& d) {
      count += glm::dot(d, d) <= kSupportRadius * kSupportRadius * h_ * h_ ? 1 : 0;
    });
    return count >= kMinSupport;
  }

  /// No other part of the mesh is nearer to the point than the edge.
  [[nodiscard]] bool is_nearest(const Vec3& p, double squared, const PointGrid& samples) const {
    bool is_nearest = true;
    samples.for_each_near(p, std::sqrt(squared), [&](const Vec3& d) {
      if (glm::dot(d, d) < squared) is_nearest = false;
    });
    return is_nearest;
  }

  [[nodiscard]] Vec3 on_cloud(const Vec3& p, const Vec3& normal) const {
    PlaneSums sums;
    const double radius2 = kFitRadius * kFitRadius * h_ * h_;
    cloud_.for_each_near(p, kFitRadius * h_, [&](const Vec3& d) {
      if (glm::dot(d, d) < radius2 && std::abs(glm::dot(d, normal)) <= kMaxHeight * h_)
        sums.add(d, 1.0);
    });
    if (sums.count() < kMinFitPoints) return p;
    const LocalPlane plane = sums.plane();
    const double cosine = glm::dot(plane.normal, normal);
    if (std::abs(cosine) < kFitMinCosine) return p;
    const double lift = glm::dot(plane.center, plane.normal) / cosine;
    return std::abs(lift) <= kMaxLift * h_ ? p + lift * normal : p;
  }

  void move(std::uint32_t v, const Vec3& target) {
    if (target == at(v)) return;
    for (const double share : {1.0, 0.5}) {
      const Vec3 place = at(v) + share * (target - at(v));
      if (!keeps_shape(v, place)) continue;
      mesh_.positions[v] = place;
      return;
    }
  }

  [[nodiscard]] bool keeps_shape(std::uint32_t v, const Vec3& place) const {
    bool ok = true;
    table_.for_each_corner(v, [&](std::uint32_t c) {
      const Vec3& p = at(table_.head(c));
      const Vec3& q = at(table_.apex(c));
      ok = ok && has_cosine(area_vector(at(v), p, q), area_vector(place, p, q), kMaxTurn) &&
           sine_of_smallest_angle(place, p, q) >=
               std::min(kSliver, sine_of_smallest_angle(at(v), p, q));
    });
    return ok;
  }

  /// Takes moves back until no face crosses another; returns how many were taken back.
  std::size_t uncross() {
    std::vector<std::uint8_t> is_reverted(border_.size(), 0);
    for (int trial = 1; trial <= kMaxTrials; ++trial) {
      const std::vector<std::uint8_t> is_crossing = crossing_vertices();
      if (is_crossing.empty()) break;
      for (std::size_t i = 0; i < border_.size(); ++i) {
        const std::uint32_t v = border_[i];
        if (at(v) == before_[i] || (trial < kMaxTrials && is_crossing[v] == 0)) continue;
        mesh_.positions[v] = trial <= kHalvings ? 0.5 * (at(v) + before_[i]) : before_[i];
        is_reverted[i] = 1;
      }
    }
    return static_cast<std::size_t>(std::count(is_reverted.begin(), is_reverted.end(), 1));
  }

  /// Flags of the vertices of faces that moved and cross others, or others that they cross; empty
  /// if there are none.
  [[nodiscard]] std::vector<std::uint8_t> crossing_vertices() const {
    std::vector<std::uint8_t> is_changed(mesh_.triangles.size(), 0);
    for (std::size_t i = 0; i < border_.size(); ++i) {
      if (at(border_[i]) == before_[i]) continue;
      table_.for_each_corner(border_[i], [&](std::uint32_t c) { is_changed[c / 3] = 1; });
    }
    std::vector<std::uint32_t> changed;
    for (std::uint32_t f = 0; f < is_changed.size(); ++f) {
      if (is_changed[f] != 0) changed.push_back(f);
    }
    if (changed.empty()) return {};
    const auto pairs = self_intersections(mesh_, changed);
    if (pairs.empty()) return {};
    std::vector<std::uint8_t> is_crossing(mesh_.positions.size(), 0);
    for (const auto& [f, g] : pairs) {
      for (const std::uint32_t face : {f, g}) {
        for (const std::uint32_t v : mesh_.triangles[face])
          is_crossing[v] = 1;
      }
    }
    return is_crossing;
  }

  TriangleMesh& mesh_;
  const CornerTable& table_;
  const PointGrid& cloud_;
  double h_;
  std::vector<std::uint32_t> border_;
  std::vector<Vec3> before_;  // positions of border_ when the round began
};

}  // namespace

ExtendBorderReport extend_border(TriangleMesh& mesh, const PointGrid& cloud,
                                 const ExtendBorderOptions& options, const Progress& progress) {
  if (cloud.empty()) return {};
  ExtendBorderReport report;
  const CornerTable table(mesh.triangles, mesh.positions.size());
  Extender extender(mesh, table, cloud, options.pixel_size);
  for (int round = 0; round < options.rounds; ++round) {
    progress.check_stop();
    extender.round(report);
  }
  return report;
}

}  // namespace rangezip
