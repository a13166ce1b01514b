#include "core/finish/snap_features.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/parallel.h"
#include "core/finish/corner_table.h"
#include "core/finish/feature_cleanup.h"
#include "core/finish/local_plane.h"

namespace rangezip {
namespace {

// Lengths are in h, angles as cosines.
constexpr double kFitRadius = 1.5;
constexpr double kFitHeight = 1.2;
constexpr int kMinFitPoints = 10;
constexpr double kCleanThickness =
    0.08;  // root mean square distance of the points of a clean plane
constexpr double kCleanFlatness = 0.0036;  // the same squared, of the width: 0.06^2
constexpr double kCleanMinCosine = 0.8;    // between the plane and the mesh
constexpr int kRings = 4;                  // where clean planes are looked for
constexpr std::size_t kMinCleanPlanes = 6;
constexpr double kFeatureCosine = 0.82;  // 35 degrees: sides of a feature differ by more
constexpr double kWeightRadius = 4.5;    // of planes in the quadric
constexpr double kHoldInPlace = 1e-3;    // weight of not moving, against sliding along an edge
constexpr double kMaxMove = 1.5;
constexpr double kProofRadius = 1.3;      // points that must lie on the planes
constexpr double kProofThickness = 0.03;  // beyond the noise of the cloud
constexpr int kMinProofPoints = 5;
constexpr std::size_t kVerticesPerBlock = 256;
constexpr std::size_t kMaxSides = 3;

struct VertexPlane {
  Vec3 center{0.0};
  Vec3 normal{0.0};
  double thickness = -1.0;  ///< mean square distance of the points, negative: too few points
  bool is_clean = false;
};

/// A clean plane next to a candidate: relative to the candidate's vertex, with its weight.
struct NearPlane {
  Vec3 center;
  Vec3 normal;
  double weight;
};

/// The planes of one side of a feature as one plane.
struct Side {
  Vec3 center{0.0};
  Vec3 normal{0.0};
  double weight = 0.0;

  void add(const NearPlane& plane) {
    center += plane.weight * plane.center;
    normal += plane.weight * plane.normal;
    weight += plane.weight;
  }
  [[nodiscard]] double distance(const Vec3& p) const {
    return std::abs(glm::dot(normal, p - center));
  }
};

class Snapper {
 public:
  Snapper(TriangleMesh& mesh, const PointGrid& cloud, double pixel_size)
      : positions_(mesh.positions),
        cloud_(cloud),
        h_(pixel_size),
        table_(mesh.triangles, mesh.positions.size()),
        planes_(mesh.positions.size()) {}

  SnapReport run(const Progress& progress) {
    fit_planes();
    noise_ = median_thickness();
    progress.check_stop();
    const std::vector<std::uint8_t> snapped = snap();
    SnapReport report;
    for (const std::uint8_t s : snapped)
      report.snapped_vertices += s;
    progress.check_stop();
    if (report.snapped_vertices == 0) return report;
    const FeatureCleanupReport cleaned = clean_features(table_, positions_, snapped, h_);
    report.collapsed_edges = cleaned.collapsed_edges;
    report.flipped_edges = cleaned.flipped_edges;
    return report;
  }
  [[nodiscard]] std::vector<Triangle> triangles() const { return table_.triangles(); }

 private:
  void fit_planes() {
    parallel_for(positions_.size(), kVerticesPerBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v)
        planes_[v] = plane_at(static_cast<std::uint32_t>(v));
    });
  }

  [[nodiscard]] Vec3 normal_at(std::uint32_t v) const {
    Vec3 normal{0.0};
    table_.for_each_corner(v, [&](std::uint32_t c) {
      normal += area_vector(positions_[v], positions_[table_.head(c)], positions_[table_.apex(c)]);
    });
    const double length = glm::length(normal);
    return length > 0.0 ? normal / length : Vec3{0.0};
  }

  [[nodiscard]] VertexPlane plane_at(std::uint32_t v) const {
    const Vec3 normal = normal_at(v);
    PlaneSums sums;
    const double radius2 = kFitRadius * kFitRadius * h_ * h_;
    cloud_.for_each_near(positions_[v], kFitRadius * h_, [&](const Vec3& d) {
      if (glm::dot(d, d) > radius2 || std::abs(glm::dot(d, normal)) > kFitHeight * h_) return;
      sums.add(d, 1.0);
    });
    VertexPlane result;
    if (sums.count() < kMinFitPoints) return result;
    const LocalPlane plane = sums.plane();
    const double cosine = glm::dot(plane.normal, normal);
    result.thickness = plane.thickness;
    result.center = positions_[v] + plane.center;
    result.normal = cosine < 0.0 ? -plane.normal : plane.normal;
    result.is_clean = plane.thickness < kCleanFlatness * plane.width &&
                      plane.thickness < kCleanThickness * kCleanThickness * h_ * h_ &&
                      std::abs(cosine) > kCleanMinCosine;
    return result;
  }

  /// What the points scatter about the surface, on average: a mean square.
  [[nodiscard]] double median_thickness() const {
    std::vector<double> values;
    for (const VertexPlane& plane : planes_) {
      if (plane.thickness >= 0.0) values.push_back(plane.thickness);
    }
    if (values.empty()) return 0.0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  }

  /// Moves what can be moved; returns flags of those vertices.
  std::vector<std::uint8_t> snap() {
    std::vector<std::uint8_t> snapped(positions_.size(), 0);
    std::vector<Vec3> moved(positions_.size());
    parallel_for(positions_.size(), kVerticesPerBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        const auto vertex = static_cast<std::uint32_t>(v);
        if (planes_[v].is_clean || table_.is_boundary(vertex)) continue;
        if (const std::optional<Vec3> target = feature_at(vertex)) {
          moved[v] = *target;
          snapped[v] = 1;
        }
      }
    });
    for (std::size_t v = 0; v < moved.size(); ++v) {
      if (snapped[v] != 0) positions_[v] = moved[v];
    }
    return snapped;
  }

  [[nodiscard]] std::vector<NearPlane> clean_planes_around(std::uint32_t v) const {
    std::vector<std::uint32_t> seen{v};
    std::vector<NearPlane> planes;
    const double per_radius2 = 1.0 / (kWeightRadius * kWeightRadius * h_ * h_);
    std::size_t begin = 0;
    for (int ring = 0; ring < kRings; ++ring) {
      const std::size_t end = seen.size();
      for (; begin < end; ++begin) {
        table_.for_each_neighbor(seen[begin], [&](std::uint32_t w) {
          if (std::find(seen.begin(), seen.end(), w) != seen.end()) return;
          seen.push_back(w);
          if (!planes_[w].is_clean) return;
          const Vec3 d = planes_[w].center - positions_[v];
          const double nearness = std::max(0.0, 1.0 - glm::dot(d, d) * per_radius2);
          const double squared = nearness * nearness;
          planes.push_back({d, planes_[w].normal, squared * squared});
        });
      }
    }
    return planes;
  }

  [[nodiscard]] std::optional<Vec3> feature_at(std::uint32_t v) const {
    const std::vector<NearPlane> planes = clean_planes_around(v);
    if (planes.size() < kMinCleanPlanes) return std::nullopt;
    const std::vector<Side> sides = sides_of(planes);
    if (sides.size() < 2) return std::nullopt;
    const std::optional<Vec3> move = meeting_place(planes);
    if (!move || glm::dot(*move, *move) > kMaxMove * kMaxMove * h_ * h_) return std::nullopt;
    if (!is_proved(positions_[v], *move, sides)) return std::nullopt;
    return positions_[v] + *move;
  }

  /// The planes in two or three groups around the normals that differ most; one group if they do
  /// not differ enough.
  [[nodiscard]] static std::vector<Side> sides_of(const std::vector<NearPlane>& planes) {
    std::array<std::size_t, kMaxSides> seeds{};
    double least = 1.0;
    for (std::size_t i = 0; i < planes.size(); ++i) {
      for (std::size_t j = i + 1; j < planes.size(); ++j) {
        const double cosine = glm::dot(planes[i].normal, planes[j].normal);
        if (cosine >= least) continue;
        least = cosine;
        seeds = {i, j, 0};
      }
    }
    if (least > kFeatureCosine) return {};
    std::size_t count = 2;
    double third = kFeatureCosine;
    for (std::size_t k = 0; k < planes.size(); ++k) {
      const double nearest = std::max(glm::dot(planes[k].normal, planes[seeds[0]].normal),
                                      glm::dot(planes[k].normal, planes[seeds[1]].normal));
      if (nearest >= third) continue;
      third = nearest;
      seeds[2] = k;
      count = 3;
    }
    std::vector<Side> sides(count);
    for (const NearPlane& plane : planes) {
      std::size_t nearest = 0;
      for (std::size_t s = 1; s < count; ++s) {
        if (glm::dot(plane.normal, planes[seeds[s]].normal) >
            glm::dot(plane.normal, planes[seeds[nearest]].normal)) {
          nearest = s;
        }
      }
      sides[nearest].add(plane);
    }
    for (Side& side : sides) {
      if (!(side.weight > 0.0)) return {};
      side.center /= side.weight;
      side.normal = glm::normalize(side.normal);
    }
    return sides;
  }

  /// The minimum of the quadric of all planes.
  [[nodiscard]] static std::optional<Vec3> meeting_place(const std::vector<NearPlane>& planes) {
    Mat3 a(kHoldInPlace);
    Vec3 b{0.0};
    for (const NearPlane& plane : planes) {
      const Vec3 weighted = plane.weight * plane.normal;
      a += glm::outerProduct(weighted, plane.normal);
      b += weighted * glm::dot(plane.normal, plane.center);
    }
    // Cramer's rule on the columns; the matrix is positive definite.
    const Vec3 c0 = glm::cross(a[1], a[2]), c1 = glm::cross(a[2], a[0]),
               c2 = glm::cross(a[0], a[1]);
    const double determinant = glm::dot(a[0], c0);
    if (!(determinant > 0.0)) return std::nullopt;
    return Vec3(glm::dot(b, c0), glm::dot(b, c1), glm::dot(b, c2)) / determinant;
  }

  /// The points next to the new place lie on the sides.
  [[nodiscard]] bool is_proved(const Vec3& p, const Vec3& move,
                               const std::vector<Side>& sides) const {
    const double radius = kProofRadius * h_;
    double sum = 0.0;
    int count = 0;
    cloud_.for_each_near(p + move, radius, [&](const Vec3& d) {
      if (glm::dot(d, d) > radius * radius) return;
      double least = radius;
      for (const Side& side : sides)
        least = std::min(least, side.distance(d + move));
      sum += least * least;
      ++count;
    });
    const double limit = kProofThickness * h_;
    return count >= kMinProofPoints && sum < (limit * limit + noise_) * count;
  }

  std::vector<Vec3>& positions_;
  const PointGrid& cloud_;
  double h_;
  CornerTable table_;
  std::vector<VertexPlane> planes_;
  double noise_ = 0.0;
};

}  // namespace

SnapReport snap_features(TriangleMesh& mesh, const PointGrid& cloud, const SnapOptions& options,
                         const Progress& progress) {
  if (cloud.empty()) return {};
  Snapper snapper(mesh, cloud, options.pixel_size);
  const SnapReport report = snapper.run(progress);
  mesh.triangles = snapper.triangles();
  return report;
}

}  // namespace rangezip
