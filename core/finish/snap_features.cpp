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
#include "core/finish/surface_fit.h"
#include "core/finish/vertex_geometry.h"

namespace rangezip {
namespace {

// Lengths are in h, angles as cosines, squared distances of points in those of the noise.
constexpr double kFitRadius = 1.5;
constexpr double kFitRadiusShare = 0.7;  // of the radius that the noise demands, if that is more
constexpr double kFitHeight = 1.2;
constexpr int kMinFitPoints = 10;
constexpr double kCleanResidual = 0.008;  // of the points about a clean surface, beyond the noise
constexpr double kSureness = 3.0;         // standard deviations
constexpr int kFitTerms = 6;
constexpr double kCleanMinCosine = 0.8;  // between the surface and the mesh
constexpr int kRings = 4;                // where clean surfaces are looked for
constexpr std::size_t kMinCleanSurfaces = 6;
constexpr double kFeatureCosine = 0.82;  // 35 degrees: sides of a feature differ by more
constexpr double kWeightRadius = 4.5;    // of surfaces in the quadric
constexpr double kHoldInPlace = 1e-3;    // weight of not moving, against sliding along an edge
constexpr double kMaxMove = 1.5;
constexpr double kReach = 0.4;          // of the edges around: vertices so near go onto the feature
constexpr double kCornerReach = 0.8;    // the same for corners, of which none may be missed
constexpr double kProofRadius = 0.87;   // of that of the fits: points that must lie on the surfaces
constexpr double kProofSureness = 1.5;  // standard deviations
constexpr double kProofResidual = 0.06;  // beyond the noise
constexpr double kSharperShare = 0.5;    // of the residual of a smooth surface
constexpr int kMinProofPoints = 5;
constexpr std::size_t kVerticesPerBlock = 256;
constexpr std::size_t kMaxSides = 3;

/// The surface around a vertex.
struct VertexSurface {
  Vec3 center{0.0};
  Vec3 normal{0.0};
  Mat3 bending{0.0};
  double residual2 = 0.0;  ///< mean square distance of the points
  bool is_clean = false;
};

/// The height of a place p over a surface next to it: constant + slope.p - p.bending.p / 2.
struct Height {
  double constant = 0.0;
  Vec3 slope{0.0};
  Mat3 bending{0.0};

  [[nodiscard]] double at(const Vec3& p) const {
    return constant + glm::dot(slope, p) - 0.5 * glm::dot(p, bending * p);
  }
  void add(const Height& other, double weight) {
    constant += weight * other.constant;
    slope += weight * other.slope;
    bending += weight * other.bending;
  }
};

/// A clean surface seen from a candidate's place, with its weight; the plane is that which touches
/// it there.
struct NearSurface {
  Height height;
  Vec3 normal;
  double weight;
};

/// The surfaces of one side of a feature as one.
struct Side {
  Height height;
  double weight = 0.0;

  /// The nearest place of the side, up to its bending.
  [[nodiscard]] Vec3 foot() const {
    return -height.constant / glm::dot(height.slope, height.slope) * height.slope;
  }
  [[nodiscard]] double distance(const Vec3& p) const { return std::abs(height.at(p)); }
};

/// Where a vertex goes.
struct Snap {
  Vec3 move{0.0};
  std::uint8_t feature = 0;  ///< 1 on an edge, 2 at a corner, 0 on a side
  VertexSurface surface;     ///< of that side
};

/// What a surface is over a place, relative to that place.
NearSurface seen_from(const Vec3& place, const VertexSurface& surface, double weight) {
  const Vec3 d = place - surface.center;
  const Vec3 bent = surface.bending * d;
  NearSurface seen;
  seen.height = {glm::dot(surface.normal, d) - 0.5 * glm::dot(d, bent), surface.normal - bent,
                 surface.bending};
  seen.normal = unit_or_z(seen.height.slope);
  seen.weight = weight;
  return seen;
}

/// The surfaces in two or three groups around the normals that differ most; none if they do not
/// differ enough.
std::vector<Side> sides_of(const std::vector<NearSurface>& surfaces) {
  const auto cosine = [&](std::size_t i, std::size_t j) {
    return glm::dot(surfaces[i].normal, surfaces[j].normal);
  };
  std::array<std::size_t, kMaxSides> seeds{};
  double least = 1.0;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    for (std::size_t j = i + 1; j < surfaces.size(); ++j) {
      if (cosine(i, j) >= least) continue;
      least = cosine(i, j);
      seeds = {i, j, 0};
    }
  }
  if (least > kFeatureCosine) return {};
  std::size_t count = 2;
  double third = kFeatureCosine;
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    const double nearest = std::max(cosine(k, seeds[0]), cosine(k, seeds[1]));
    if (nearest >= third) continue;
    third = nearest;
    seeds[2] = k;
    count = 3;
  }
  std::vector<Side> sides(count);
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    std::size_t nearest = 0;
    for (std::size_t s = 1; s < count; ++s) {
      if (cosine(k, seeds[s]) > cosine(k, seeds[nearest])) nearest = s;
    }
    sides[nearest].height.add(surfaces[k].height, surfaces[k].weight);
    sides[nearest].weight += surfaces[k].weight;
  }
  for (Side& side : sides) {
    if (!(side.weight > 0.0)) return {};
    Height mean;
    mean.add(side.height, 1.0 / side.weight);
    side.height = mean;
  }
  return sides;
}

/// The minimum of the quadric of all planes.
std::optional<Vec3> meeting_place(const std::vector<NearSurface>& surfaces) {
  Mat3 a(kHoldInPlace);
  Vec3 b{0.0};
  for (const NearSurface& s : surfaces) {
    const double length = glm::length(s.height.slope);
    const Vec3 weighted = s.weight * s.normal;
    a += glm::outerProduct(weighted, s.normal);
    b -= s.height.constant / length * weighted;
  }
  // Cramer's rule on the columns; the matrix is positive definite.
  const Vec3 c0 = glm::cross(a[1], a[2]), c1 = glm::cross(a[2], a[0]), c2 = glm::cross(a[0], a[1]);
  const double determinant = glm::dot(a[0], c0);
  if (!(determinant > 0.0)) return std::nullopt;
  return Vec3(glm::dot(b, c0), glm::dot(b, c1), glm::dot(b, c2)) / determinant;
}

/// The place on both planes that is nearest to `place`; nothing if they hardly differ.
std::optional<Vec3> place_on_both(const Vec3& place, const VertexSurface& a,
                                  const VertexSurface& b) {
  const double cosine = glm::dot(a.normal, b.normal);
  if (cosine > kFeatureCosine) return std::nullopt;
  const double to_a = glm::dot(a.normal, a.center - place),
               to_b = glm::dot(b.normal, b.center - place);
  const double determinant = 1.0 - cosine * cosine;
  if (!(determinant > 0.0)) return std::nullopt;
  return place +
         ((to_a - cosine * to_b) * a.normal + (to_b - cosine * to_a) * b.normal) / determinant;
}

class Snapper {
 public:
  Snapper(TriangleMesh& mesh, const PointGrid& cloud, const SnapOptions& options)
      : positions_(mesh.positions),
        cloud_(cloud),
        h_(options.pixel_size),
        noise2_(options.fit.noise * options.fit.noise),
        window_{std::max(kFitRadius * h_, kFitRadiusShare * options.fit.window.radius),
                std::max(kFitHeight * h_, options.fit.window.height)},
        table_(mesh.triangles, mesh.positions.size()),
        surfaces_(mesh.positions.size()) {}

  SnapReport run(const Progress& progress) {
    fit_surfaces();
    progress.check_stop();
    SnapReport report;
    const std::vector<Vec3> before = positions_;
    std::vector<std::uint8_t> is_feature = snap();
    report.split_edges = split_crossing_edges(is_feature);
    report.snapped_vertices = is_feature.size() - static_cast<std::size_t>(std::count(
                                                      is_feature.begin(), is_feature.end(), 0));
    progress.check_stop();
    if (report.snapped_vertices == 0) {
      positions_ = before;  // sides without an edge between them
      return report;
    }
    const FeatureCleanupReport cleaned = clean_features(table_, positions_, is_feature, h_);
    report.collapsed_edges = cleaned.collapsed_edges;
    report.flipped_edges = cleaned.flipped_edges;
    return report;
  }
  [[nodiscard]] std::vector<Triangle> triangles() const { return table_.triangles(); }

 private:
  void fit_surfaces() {
    parallel_for(positions_.size(), kVerticesPerBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v)
        surfaces_[v] = surface_at(static_cast<std::uint32_t>(v));
    });
  }

  [[nodiscard]] VertexSurface surface_at(std::uint32_t v) const {
    const Vec3 normal = vertex_normal(table_, positions_, v);
    const auto [fit, scatter] = measure_surface(cloud_, positions_[v], normal, window_);
    if (!fit.is_found || fit.count < kMinFitPoints) return {};
    // Of pure noise, hardly a mean square is larger.
    const double most_noise = 1.0 + kSureness * std::sqrt(2.0 / (fit.count - kFitTerms));
    const double limit = kCleanResidual * h_;
    return {.center = positions_[v] + fit.height * normal,
            .normal = fit.normal,
            .bending = fit.bending,
            .residual2 = scatter.noise2,
            .is_clean = scatter.noise2 < limit * limit + most_noise * noise2_ &&
                        glm::dot(fit.normal, normal) > kCleanMinCosine};
  }

  /// Moves what can be moved; returns flags of the vertices that are on features now.
  std::vector<std::uint8_t> snap() {
    std::vector<std::optional<Snap>> snaps(positions_.size());
    parallel_for(positions_.size(), kVerticesPerBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        const auto vertex = static_cast<std::uint32_t>(v);
        if (!surfaces_[v].is_clean && !table_.is_boundary(vertex)) snaps[v] = snap_of(vertex);
      }
    });
    std::vector<std::uint8_t> is_feature(positions_.size(), 0);
    for (std::size_t v = 0; v < snaps.size(); ++v) {
      if (!snaps[v]) continue;
      positions_[v] += snaps[v]->move;
      is_feature[v] = snaps[v]->feature;
      if (snaps[v]->feature == 0) surfaces_[v] = snaps[v]->surface;
    }
    return is_feature;
  }

  [[nodiscard]] std::optional<Snap> snap_of(std::uint32_t v) const {
    const std::vector<NearSurface> surfaces = clean_surfaces_around(v);
    if (surfaces.size() < kMinCleanSurfaces) return std::nullopt;
    const std::vector<Side> sides = sides_of(surfaces);
    if (sides.size() < 2) return std::nullopt;
    const std::optional<Vec3> move = meeting_place(surfaces);
    if (!move || glm::length(*move) > kMaxMove * h_) return std::nullopt;
    if (!is_proved(v, *move, sides)) return std::nullopt;
    const double reach = sides.size() == kMaxSides ? kCornerReach : kReach;
    if (glm::length(*move) <= reach * mean_edge_at(v))
      return Snap{*move, static_cast<std::uint8_t>(sides.size() - 1), {}};
    const Side& nearest = *std::min_element(
        sides.begin(), sides.end(),
        [](const Side& a, const Side& b) { return a.distance(Vec3{0.0}) < b.distance(Vec3{0.0}); });
    return Snap{nearest.foot(),
                0,
                {.center = positions_[v] + nearest.foot(),
                 .normal = unit_or_z(nearest.height.slope),
                 .bending = nearest.height.bending,
                 .residual2 = noise2_,
                 .is_clean = true}};
  }

  [[nodiscard]] std::vector<NearSurface> clean_surfaces_around(std::uint32_t v) const {
    std::vector<std::uint32_t> seen{v};
    std::vector<NearSurface> surfaces;
    const double per_radius2 = 1.0 / (kWeightRadius * kWeightRadius * h_ * h_);
    std::size_t begin = 0;
    for (int ring = 0; ring < kRings; ++ring) {
      const std::size_t end = seen.size();
      for (; begin < end; ++begin) {
        table_.for_each_neighbor(seen[begin], [&](std::uint32_t w) {
          if (std::find(seen.begin(), seen.end(), w) != seen.end()) return;
          seen.push_back(w);
          if (!surfaces_[w].is_clean) return;
          const Vec3 d = surfaces_[w].center - positions_[v];
          const double nearness = std::max(0.0, 1.0 - glm::dot(d, d) * per_radius2);
          const double squared = nearness * nearness;
          surfaces.push_back(seen_from(positions_[v], surfaces_[w], squared * squared));
        });
      }
    }
    return surfaces;
  }

  [[nodiscard]] double mean_edge_at(std::uint32_t v) const {
    double sum = 0.0;
    int count = 0;
    table_.for_each_neighbor(v, [&](std::uint32_t w) {
      sum += glm::length(positions_[w] - positions_[v]);
      ++count;
    });
    return count > 0 ? sum / count : 0.0;
  }

  /// The points next to the new place lie on the sides, and much closer than on a smooth surface.
  [[nodiscard]] bool is_proved(std::uint32_t v, const Vec3& move,
                               const std::vector<Side>& sides) const {
    const double radius = kProofRadius * window_.radius;
    double sum = 0.0;
    int count = 0;
    cloud_.for_each_near(positions_[v] + move, radius, [&](const Vec3& d) {
      if (glm::dot(d, d) > radius * radius) return;
      double least = radius;
      for (const Side& side : sides)
        least = std::min(least, side.distance(d + move));
      sum += least * least;
      ++count;
    });
    if (count < kMinProofPoints) return false;
    const double limit = kProofResidual * h_;
    const double scatter = 1.0 + kProofSureness * std::sqrt(2.0 / count);
    const double residual2 = sum / count;
    const double smooth_excess = surfaces_[v].residual2 - noise2_;
    return residual2 < limit * limit + scatter * noise2_ && smooth_excess > noise2_ &&
           residual2 - noise2_ < kSharperShare * smooth_excess;
  }

  /// Edges between clean sides of a feature, none of whose ends is on it.
  std::size_t split_crossing_edges(std::vector<std::uint8_t>& is_feature) {
    std::size_t count = 0;
    const auto corners = static_cast<std::uint32_t>(table_.corner_count());
    for (std::uint32_t c = 0; c < corners; ++c) {
      if (!table_.names_inner_edge(c)) continue;
      const std::uint32_t a = table_.vertex(c), b = table_.head(c);
      if (is_feature[a] != 0 || is_feature[b] != 0) continue;
      if (!surfaces_[a].is_clean || !surfaces_[b].is_clean) continue;
      const Vec3 middle = 0.5 * (positions_[a] + positions_[b]);
      const std::optional<Vec3> place = place_on_both(middle, surfaces_[a], surfaces_[b]);
      if (!place || glm::distance(*place, middle) > glm::distance(positions_[a], positions_[b]))
        continue;
      table_.split_edge(c);
      positions_.push_back(*place);
      surfaces_.emplace_back();
      is_feature.push_back(1);
      ++count;
    }
    return count;
  }

  std::vector<Vec3>& positions_;
  const PointGrid& cloud_;
  double h_;
  double noise2_;  ///< mean square distance of points from the surface
  SurfaceWindow window_;
  CornerTable table_;
  std::vector<VertexSurface> surfaces_;
};

}  // namespace

SnapReport snap_features(TriangleMesh& mesh, const PointGrid& cloud, const SnapOptions& options,
                         const Progress& progress) {
  if (cloud.empty()) return {};
  Snapper snapper(mesh, cloud, options);
  const SnapReport report = snapper.run(progress);
  mesh.triangles = snapper.triangles();
  if (!mesh.sources.empty()) mesh.sources.resize(mesh.positions.size());
  return report;
}

}  // namespace rangezip
