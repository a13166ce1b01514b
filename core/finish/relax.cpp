#include "core/finish/relax.h"

#include <array>
#include <cmath>
#include <vector>

#include "core/base/parallel.h"
#include "core/finish/corner_table.h"
#include "core/finish/local_plane.h"
#include "core/finish/spikes.h"
#include "core/finish/triangle_shape.h"

namespace rangezip {
namespace {

// Lengths are in h, angles as cosines, and smallest angles as sines.
constexpr double kShortEdge = 0.5;
constexpr double kCollapseTurn = 0.7;  // 45 degrees: a collapse may tilt a face so much
constexpr double kMinAngleAfterCollapse = 0.15;
constexpr double kFlipGain = 0.05;       // smaller gains would flip to and fro
constexpr double kFlipMinCosine = 0.5;   // between and against the old faces
constexpr double kFlipMaxSharper = 0.1;  // a flip may not make an edge much sharper
constexpr double kRelaxStep = 0.5;
constexpr double kMaxTurn = 0.5;           // 60 degrees
constexpr double kSliver = 0.1;            // a face with less than this has no direction to keep
constexpr std::array kFitRadii{1.3, 2.1};  // the wider where the cloud is sparse
constexpr double kFitHeightShare = 0.54;   // of the radius; points farther from the tangent plane
                                           // belong to another sheet
constexpr double kMaxProjectionShare = 0.54;  // of the radius
constexpr int kMinFitPoints = 10;
constexpr double kFitMinCosine = 0.6;     // between the fitted plane and the mesh
constexpr double kFitMaxThickness = 0.2;  // of the width: else the points are no plane
constexpr std::size_t kVerticesPerBlock = 1024;

class Relaxer {
 public:
  Relaxer(TriangleMesh& mesh, const PointGrid& cloud, double pixel_size)
      : positions_(mesh.positions),
        cloud_(cloud),
        h_(pixel_size),
        table_(mesh.triangles, mesh.positions.size()) {}

  void round(RelaxReport& report) {
    report.collapsed_edges += collapse_short_edges();
    report.flipped_edges += flip_edges();
    report.flattened_spikes += flatten_spikes(positions_, table_, cloud_, h_);
    move_vertices();
  }
  [[nodiscard]] std::vector<Triangle> triangles() const { return table_.triangles(); }

 private:
  [[nodiscard]] const Vec3& at(std::uint32_t vertex) const { return positions_[vertex]; }
  [[nodiscard]] Vec3 area_of(std::uint32_t face) const {
    const Triangle t = table_.triangle(face);
    return area_vector(at(t[0]), at(t[1]), at(t[2]));
  }
  /// Each edge once.
  [[nodiscard]] bool names_edge(std::uint32_t c) const {
    const std::uint32_t other = table_.across(c);
    return !table_.is_deleted(c / 3) && (other == CornerTable::kNone || c < other);
  }

  std::size_t collapse_short_edges() {
    std::size_t count = 0;
    const double limit = kShortEdge * kShortEdge * h_ * h_;
    for (std::uint32_t c = 0; c < table_.corner_count(); ++c) {
      if (!names_edge(c) || table_.across(c) == CornerTable::kNone) continue;
      const Vec3 edge = at(table_.head(c)) - at(table_.vertex(c));
      if (glm::dot(edge, edge) > limit) continue;
      for (const std::uint32_t side : {c, table_.across(c)}) {
        if (!table_.is_collapse_ok(side) || !keeps_shape(side)) continue;
        table_.collapse(side);
        ++count;
        break;
      }
    }
    return count;
  }

  /// Moving the half-edge's vertex into its head neither turns a face nor makes a sliver.
  [[nodiscard]] bool keeps_shape(std::uint32_t corner) const {
    const std::uint32_t target = table_.head(corner);
    bool ok = true;
    table_.for_each_corner(table_.vertex(corner), [&](std::uint32_t c) {
      const std::uint32_t p = table_.head(c), q = table_.apex(c);
      if (!ok || p == target || q == target) return;
      const Vec3 before = area_vector(at(table_.vertex(c)), at(p), at(q));
      const Vec3 after = area_vector(at(target), at(p), at(q));
      ok = has_cosine(before, after, kCollapseTurn) &&
           sine_of_smallest_angle(at(target), at(p), at(q)) >= kMinAngleAfterCollapse;
    });
    return ok;
  }

  std::size_t flip_edges() {
    std::size_t count = 0;
    for (std::uint32_t c = 0; c < table_.corner_count(); ++c) {
      if (!names_edge(c) || table_.across(c) == CornerTable::kNone) continue;
      if (!is_better_flipped(c) || !table_.is_flip_ok(c)) continue;
      table_.flip(c);
      ++count;
    }
    return count;
  }

  [[nodiscard]] bool is_better_flipped(std::uint32_t corner) const {
    const Vec3& a = at(table_.vertex(corner));
    const Vec3& b = at(table_.head(corner));
    const Vec3& x = at(table_.apex(corner));
    const Vec3& y = at(table_.apex(table_.across(corner)));
    const double before =
        std::min(sine_of_smallest_angle(a, b, x), sine_of_smallest_angle(b, a, y));
    const double after = std::min(sine_of_smallest_angle(a, y, x), sine_of_smallest_angle(b, x, y));
    if (!(after >= before + kFlipGain)) return false;
    const Vec3 old_x = glm::normalize(area_vector(a, b, x));
    const Vec3 old_y = glm::normalize(area_vector(b, a, y));
    const Vec3 new_a = glm::normalize(area_vector(a, y, x));
    const Vec3 new_b = glm::normalize(area_vector(b, x, y));
    // A face without area has no direction; comparisons with it are false.
    const double sharpness = glm::dot(new_a, new_b);
    return sharpness >= kFlipMinCosine && !(sharpness < glm::dot(old_x, old_y) - kFlipMaxSharper) &&
           !(glm::dot(new_a, old_y) < kFlipMinCosine) && !(glm::dot(new_b, old_x) < kFlipMinCosine);
  }

  void move_vertices() {
    std::vector<Vec3> moved(positions_.size());
    parallel_for(positions_.size(), kVerticesPerBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v)
        moved[v] = place_for(static_cast<std::uint32_t>(v));
    });
    for (std::uint32_t v = 0; v < positions_.size(); ++v) {
      if (moved[v] != positions_[v] && turns_no_face(v, moved[v])) positions_[v] = moved[v];
    }
  }

  [[nodiscard]] Vec3 place_for(std::uint32_t v) const {
    const Vec3& p = at(v);
    if (table_.is_boundary(v)) return p;
    Vec3 sum{0.0}, normal{0.0};
    int count = 0;
    table_.for_each_corner(v, [&](std::uint32_t c) {
      sum += at(table_.head(c));
      ++count;
      normal += area_of(c / 3);
    });
    const double length = glm::length(normal);
    if (!(length > 0.0)) return p;
    normal /= length;
    const Vec3 shift = sum / static_cast<double>(count) - p;
    const Vec3 evened = p + kRelaxStep * (shift - glm::dot(shift, normal) * normal);
    return projected(evened, normal);
  }

  /// Onto the local plane of the cloud, if its points there are one.
  [[nodiscard]] Vec3 projected(const Vec3& p, const Vec3& normal) const {
    for (const double share : kFitRadii) {
      const double radius = share * h_;
      const PlaneSums sums = sums_around(p, normal, radius);
      if (sums.count() < kMinFitPoints) continue;
      const LocalPlane plane = sums.plane();
      if (std::abs(glm::dot(plane.normal, normal)) < kFitMinCosine) return p;
      if (plane.thickness > kFitMaxThickness * plane.width) return p;
      const double distance = glm::dot(plane.center, plane.normal);
      if (std::abs(distance) > kMaxProjectionShare * radius) return p;
      return p + distance * plane.normal;
    }
    return p;
  }

  /// The points of the sheet around p, about p.
  [[nodiscard]] PlaneSums sums_around(const Vec3& p, const Vec3& normal, double radius) const {
    PlaneSums sums;
    const double per_radius2 = 1.0 / (radius * radius);
    const double height = kFitHeightShare * radius;
    cloud_.for_each_near(p, radius, [&](const Vec3& d) {
      const double nearness = 1.0 - glm::dot(d, d) * per_radius2;
      if (nearness <= 0.0 || std::abs(glm::dot(d, normal)) > height) return;
      const double squared = nearness * nearness;
      sums.add(d, squared * squared);  // nearly a Gaussian of a third of the radius, but compact
    });
    return sums;
  }

  [[nodiscard]] bool turns_no_face(std::uint32_t v, const Vec3& target) const {
    bool ok = true;
    table_.for_each_corner(v, [&](std::uint32_t c) {
      if (!ok) return;
      const Vec3& p = at(table_.head(c));
      const Vec3& q = at(table_.apex(c));
      ok = has_cosine(area_vector(at(v), p, q), area_vector(target, p, q), kMaxTurn) ||
           sine_of_smallest_angle(at(v), p, q) <= kSliver;
    });
    return ok;
  }

  std::vector<Vec3>& positions_;
  const PointGrid& cloud_;
  double h_;
  CornerTable table_;
};

}  // namespace

RelaxReport relax(TriangleMesh& mesh, const PointGrid& cloud, const RelaxOptions& options,
                  const Progress& progress) {
  RelaxReport report;
  Relaxer relaxer(mesh, cloud, options.pixel_size);
  for (int round = 0; round < options.rounds; ++round) {
    progress.check_stop();
    relaxer.round(report);
  }
  mesh.triangles = relaxer.triangles();
  return report;
}

}  // namespace rangezip
