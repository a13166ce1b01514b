#include "core/finish/snap_features.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/parallel.h"
#include "core/finish/corner_table.h"
#include "core/finish/feature_cleanup.h"
#include "core/finish/feature_place.h"
#include "core/finish/feature_sides.h"
#include "core/finish/refit_sides.h"
#include "core/finish/relax_features.h"
#include "core/finish/surface_fit.h"
#include "core/finish/vertex_geometry.h"

namespace rangezip {
namespace {

// Lengths are in h, angles as cosines, squared distances of points in those of the noise.
constexpr double kFitRadius = 1.5;
constexpr double kFitRadiusShare = 0.7;  // of the radius that the noise demands, if that is more
constexpr double kFitHeight = 1.2;
constexpr int kMinFitPoints = 12;
constexpr std::array kWiderWindows{1.0, 1.3, 1.7};  // where points are few
constexpr double kCleanResidual = 0.008;  // of the points about a clean surface, beyond the noise
constexpr double kSureness = 3.0;         // standard deviations
constexpr int kFitTerms = 6;
constexpr double kCleanMinCosine = 0.8;  // between the surface and the mesh
constexpr int kRings = 4;                // where clean surfaces are looked for
constexpr std::size_t kMinCleanSurfaces = 6;
constexpr double kWeightRadius = 4.5;  // of surfaces in the mean of a side
constexpr double kStep = 0.3;          // beyond the noise: surfaces so far apart are two sides
constexpr double kSplitReach = 0.7;    // of an edge: it crosses the feature so near its middle
constexpr double kCornerReach = 1.4;   // of the way from the middle of a face to a vertex
constexpr double kTaken = 0.35;        // no vertex comes so near to one on a feature
constexpr double kFaceCosine = 0.5;    // between a face and its side
constexpr double kRefitNoise = 0.1;    // more tells hardly where a side is from a few points
constexpr int kLateRounds = 2;         // next to features that are there
constexpr int kTidyRounds = 3;
constexpr double kPixelPerEdge = 0.9;  // two triangles a pixel have edges of 1.1 of its side
constexpr std::size_t kVerticesPerBlock = 256;

/// The surface around a vertex.
struct VertexSurface {
  Vec3 center{0.0};
  Vec3 normal{0.0};
  Mat3 bending{0.0};
  double residual2 = 0.0;  ///< mean square distance of the points
  bool is_clean = false;
};

/// Where a vertex goes.
struct Snap {
  Vec3 move{0.0};
  std::uint8_t feature = 0;          ///< 1 on an edge, 2 at a corner, 0 on a side
  std::vector<FeatureSide> meeting;  ///< the sides that meet there, relative to the old place
  VertexSurface surface;             ///< of the side
};

/// The sides that meet in a vertex on a feature.
struct Feature {
  Vec3 origin{0.0};  ///< where the vertex was
  std::vector<FeatureSide> sides;
};

/// What a surface is over a place, relative to that place.
FeatureSide seen_from(const Vec3& place, const VertexSurface& surface, double weight) {
  const Vec3 d = place - surface.center;
  const Vec3 bent = surface.bending * d;
  return {{glm::dot(surface.normal, d) - 0.5 * glm::dot(d, bent), surface.normal - bent,
           surface.bending},
          weight};
}

class Snapper {
 public:
  Snapper(TriangleMesh& mesh, const PointGrid& cloud, const SnapOptions& options)
      : positions_(mesh.positions),
        cloud_(cloud),
        options_(options),
        noise2_(options.fit.noise * options.fit.noise),
        table_(mesh.triangles, mesh.positions.size()),
        surfaces_(mesh.positions.size()),
        features_(mesh.positions.size()) {}

  SnapReport run(const Progress& progress) {
    fit_surfaces();
    progress.check_stop();
    SnapReport report;
    const std::vector<Vec3> before = positions_;
    std::vector<std::uint8_t> is_feature(positions_.size(), 0);
    snap(is_feature, [&](std::uint32_t v) { return snap_of(v, clean_surfaces_around(v)); });
    for (int round = 0; round < kLateRounds; ++round)
      snap(is_feature, [&](std::uint32_t v) { return late_snap_of(v, is_feature); });
    report.split_edges = split_crossing_edges(is_feature);
    report.snapped_vertices = is_feature.size() - static_cast<std::size_t>(std::count(
                                                      is_feature.begin(), is_feature.end(), 0));
    progress.check_stop();
    if (report.snapped_vertices == 0) {
      positions_ = before;  // sides without an edge between them
      return report;
    }
    for (int round = 0; round < kTidyRounds; ++round) {
      if (round > 0) report.split_edges += split_crossing_edges(is_feature);
      const FeatureCleanupReport cleaned =
          clean_features(table_, positions_, is_feature, pixel_of_edges(), options_.sizes);
      report.collapsed_edges += cleaned.collapsed_edges;
      report.flipped_edges += cleaned.flipped_edges;
      take_back_lone(is_feature);
      report.split_edges += split_cut_corners(is_feature);
      relax_features(
          table_, positions_, is_feature,
          {[&](std::uint32_t v, const Vec3& target) { return place_on(v, target); },
           [&](std::uint32_t v, const Vec3& direction) { return may_face(v, direction); }});
    }
    return report;
  }
  [[nodiscard]] std::vector<Triangle> triangles() const { return table_.triangles(); }

 private:
  [[nodiscard]] double h_at(const Vec3& place) const {
    return options_.pixel_size * options_.sizes.at(place);
  }

  /// h, or what it would be for scans that give triangles as small as these.
  [[nodiscard]] double pixel_of_edges() const {
    const double h = options_.pixel_size;
    return options_.edge > 0.0 ? std::min(h, kPixelPerEdge * options_.edge) : h;
  }

  [[nodiscard]] double step_at(const Vec3& place) const {
    return kStep * h_at(place) + kSureness * std::sqrt(noise2_);
  }

  [[nodiscard]] SurfaceWindow window_at(const Vec3& place) const {
    const SurfaceWindow& demanded = options_.fit.window;
    const double h = h_at(place);
    return {std::max(kFitRadius * h, kFitRadiusShare * demanded.radius),
            std::max(kFitHeight * h, demanded.height), 0.0};
  }

  void fit_surfaces() {
    parallel_for(positions_.size(), kVerticesPerBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v)
        surfaces_[v] = surface_at(static_cast<std::uint32_t>(v));
    });
  }

  [[nodiscard]] VertexSurface surface_at(std::uint32_t v) const {
    const Vec3 normal = vertex_normal(table_, positions_, v);
    const double h = h_at(positions_[v]);
    const auto [fit, scatter] = measured_at(positions_[v], normal);
    if (!fit.is_found || fit.count < kMinFitPoints) return {.residual2 = h * h};
    // Of pure noise, hardly a mean square is larger.
    const double most_noise = 1.0 + kSureness * std::sqrt(2.0 / (fit.count - kFitTerms));
    const double limit = kCleanResidual * h;
    return {.center = positions_[v] + fit.height * normal,
            .normal = fit.normal,
            .bending = fit.bending,
            .residual2 = scatter.noise2,
            .is_clean = scatter.noise2 < limit * limit + most_noise * noise2_ &&
                        glm::dot(fit.normal, normal) > kCleanMinCosine};
  }

  /// Where points are few, of a wider window.
  [[nodiscard]] MeasuredFit measured_at(const Vec3& place, const Vec3& normal) const {
    const SurfaceWindow window = window_at(place);
    MeasuredFit measured;
    for (const double wider : kWiderWindows) {
      measured =
          measure_surface(cloud_, place, normal, {wider * window.radius, window.height, 0.0});
      if (measured.fit.is_found && measured.fit.count >= kMinFitPoints) break;
    }
    return measured;
  }

  /// Moves what can be moved of what has not been, and flags the vertices that are on features now.
  template <class SnapOf>
  void snap(std::vector<std::uint8_t>& is_feature, const SnapOf& snap_of_vertex) {
    std::vector<std::optional<Snap>> snaps(positions_.size());
    parallel_for(positions_.size(), kVerticesPerBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        const auto vertex = static_cast<std::uint32_t>(v);
        if (!surfaces_[v].is_clean && is_feature[v] == 0 && !table_.is_boundary(vertex))
          snaps[v] = snap_of_vertex(vertex);
      }
    });
    for (std::size_t v = 0; v < snaps.size(); ++v) {
      if (!snaps[v]) continue;
      features_[v] = {positions_[v], std::move(snaps[v]->meeting)};
      positions_[v] += snaps[v]->move;
      is_feature[v] = snaps[v]->feature;
      if (snaps[v]->feature == 0) surfaces_[v] = snaps[v]->surface;
    }
  }

  /// Where the sides of the surfaces around meet as they are, or fitted to the points.
  [[nodiscard]] std::optional<Snap> snap_of(std::uint32_t v,
                                            std::vector<FeatureSide> surfaces) const {
    if (surfaces.size() < kMinCleanSurfaces) return std::nullopt;
    const Vec3& origin = positions_[v];
    Surroundings around = surroundings(origin, sides_of(std::move(surfaces), step_at(origin)));
    const double edge = mean_edge_at(v);
    FeaturePlace found = find_feature_place(around, edge, surfaces_[v].residual2);
    if (found.count == 0 && std::sqrt(noise2_) <= kRefitNoise * around.pixel_size) {
      around.sides = refit_sides(around);
      found = find_feature_place(around, edge, surfaces_[v].residual2);
    }
    if (found.count == 0) return std::nullopt;
    Snap snap{found.place, static_cast<std::uint8_t>(found.count - 1), {}, {}};
    const FeatureSide& first = around.sides[found.sides[0]];
    if (found.count == 1) snap.surface = surface_of(first, positions_[v], found.place);
    if (found.count == 2) snap.meeting = {first, around.sides[found.sides[1]]};
    return snap;
  }

  /// With the sides of the features next to it, which are proved.
  [[nodiscard]] std::optional<Snap> late_snap_of(
      std::uint32_t v, const std::vector<std::uint8_t>& is_feature) const {
    std::vector<FeatureSide> sides;
    table_.for_each_neighbor(v, [&](std::uint32_t w) {
      if (is_feature[w] == 0) return;
      const Vec3 d = positions_[v] - features_[w].origin;
      const double weight = weight_of(d, v);
      if (!(weight > 0.0)) return;
      for (const FeatureSide& side : features_[w].sides)
        sides.push_back({side.height.seen_from(d), weight});
    });
    if (sides.empty()) return std::nullopt;
    std::vector<FeatureSide> surfaces = clean_surfaces_around(v);
    surfaces.insert(surfaces.end(), sides.begin(), sides.end());
    return snap_of(v, std::move(surfaces));
  }

  /// Of a surface so far from a vertex in the mean of a side.
  [[nodiscard]] double weight_of(const Vec3& d, std::uint32_t v) const {
    const double radius = kWeightRadius * h_at(positions_[v]);
    const double nearness = std::max(0.0, 1.0 - glm::dot(d, d) / (radius * radius));
    const double squared = nearness * nearness;
    return squared * squared;
  }

  [[nodiscard]] Surroundings surroundings(const Vec3& place, std::vector<FeatureSide> sides) const {
    return {cloud_, h_at(place), window_at(place).radius, noise2_, place, std::move(sides)};
  }

  [[nodiscard]] VertexSurface surface_of(const FeatureSide& side, const Vec3& origin,
                                         const Vec3& place) const {
    return {.center = origin + place,
            .normal = unit_or_z(side.height.slope_at(place)),
            .bending = side.height.bending,
            .residual2 = noise2_,
            .is_clean = true};
  }

  [[nodiscard]] std::vector<FeatureSide> clean_surfaces_around(std::uint32_t v) const {
    std::vector<std::uint32_t> seen{v};
    std::vector<FeatureSide> surfaces;
    std::size_t begin = 0;
    for (int ring = 0; ring < kRings; ++ring) {
      const std::size_t end = seen.size();
      for (; begin < end; ++begin) {
        table_.for_each_neighbor(seen[begin], [&](std::uint32_t w) {
          if (std::find(seen.begin(), seen.end(), w) != seen.end()) return;
          seen.push_back(w);
          if (!surfaces_[w].is_clean) return;
          const double weight = weight_of(surfaces_[w].center - positions_[v], v);
          if (weight > 0.0) surfaces.push_back(seen_from(positions_[v], surfaces_[w], weight));
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

  /// Vertices on a feature on their own: features are lines.
  void take_back_lone(std::vector<std::uint8_t>& is_feature) {
    for (std::uint32_t v = 0; v < is_feature.size(); ++v) {
      if (is_feature[v] == 0 || table_.corner_of(v) == CornerTable::kNone) continue;
      bool is_lone = true;
      table_.for_each_neighbor(v,
                               [&](std::uint32_t w) { is_lone = is_lone && is_feature[w] == 0; });
      if (!is_lone) continue;
      positions_[v] = features_[v].origin;
      is_feature[v] = 0;
      features_[v] = {};
    }
  }

  /// See VertexSides.
  [[nodiscard]] std::optional<Vec3> place_on(std::uint32_t v, const Vec3& target) const {
    std::vector<FeatureSide> sides;
    for (const FeatureSide& side : features_[v].sides)
      sides.push_back({side.height.seen_from(target - features_[v].origin), side.weight});
    if (sides.empty() && surfaces_[v].is_clean)
      sides.push_back(seen_from(target, surfaces_[v], 1.0));
    if (sides.empty()) return std::nullopt;
    const std::optional<Vec3> place = meeting_place(sides);
    if (!place || glm::length(*place) > h_at(target)) return std::nullopt;
    return target + *place;
  }

  /// See VertexSides.
  [[nodiscard]] bool may_face(std::uint32_t v, const Vec3& direction) const {
    const Feature& feature = features_[v];
    if (feature.sides.empty())
      return !surfaces_[v].is_clean || has_cosine(surfaces_[v].normal, direction, kFaceCosine);
    return std::any_of(feature.sides.begin(), feature.sides.end(), [&](const FeatureSide& side) {
      return has_cosine(side.height.slope, direction, kFaceCosine);
    });
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
      const Surroundings around = surroundings(
          middle, {seen_from(middle, surfaces_[a], 1.0), seen_from(middle, surfaces_[b], 1.0)});
      if (is_one_side(around.sides[0], around.sides[1])) continue;
      const std::optional<Vec3> place = meeting_place(around.sides);
      if (!place || glm::length(*place) > kSplitReach * glm::distance(positions_[a], positions_[b]))
        continue;
      if (!residual2_of_sides(around, *place, {0, 1})) continue;
      const Vec3 crossing = middle + *place;
      const std::uint32_t x = table_.apex(c), y = table_.apex(table_.across(c));
      if (is_near(x, crossing, is_feature, 1) || is_near(y, crossing, is_feature, 1)) continue;
      table_.split_edge(c);
      positions_.push_back(crossing);
      surfaces_.emplace_back();
      features_.push_back({middle, around.sides});
      is_feature.push_back(1);
      ++count;
    }
    return count;
  }

  /// Whether a vertex on a feature, or at a corner (2), is next to a place.
  [[nodiscard]] bool is_near(std::uint32_t v, const Vec3& place,
                             const std::vector<std::uint8_t>& is_feature, int least) const {
    return is_feature[v] >= least && glm::distance(positions_[v], place) < kTaken * h_at(place);
  }

  /// Faces between three edges of features that meet in a corner, where no vertex is.
  std::size_t split_cut_corners(std::vector<std::uint8_t>& is_feature) {
    std::size_t count = 0;
    const auto faces = static_cast<std::uint32_t>(table_.face_count());
    for (std::uint32_t f = 0; f < faces; ++f) {
      if (table_.is_deleted(f)) continue;
      const Triangle t = table_.triangle(f);
      if (is_feature[t[0]] != 1 || is_feature[t[1]] != 1 || is_feature[t[2]] != 1) continue;
      const std::uint32_t c = longest_edge(f);
      const std::optional<Vec3> corner = corner_over(t);
      if (!corner || has_corner(t, *corner, is_feature)) continue;
      if (table_.across(c) == CornerTable::kNone) continue;
      table_.split_edge(c);
      positions_.push_back(*corner);
      surfaces_.emplace_back();
      features_.push_back({*corner, {}});
      is_feature.push_back(2);
      ++count;
    }
    return count;
  }

  /// Where the sides meet that meet in pairs at the vertices of a face.
  [[nodiscard]] std::optional<Vec3> corner_over(const Triangle& t) const {
    const Vec3 middle = (positions_[t[0]] + positions_[t[1]] + positions_[t[2]]) / 3.0;
    std::vector<FeatureSide> sides;
    double reach = 0.0;
    for (const std::uint32_t v : t) {
      for (const FeatureSide& side : features_[v].sides)
        sides.push_back({side.height.seen_from(middle - features_[v].origin), 1.0});
      reach = std::max(reach, kCornerReach * glm::distance(positions_[v], middle));
    }
    const Surroundings around = surroundings(middle, sides_of(std::move(sides), step_at(middle)));
    if (around.sides.size() != 3) return std::nullopt;
    for (std::size_t i = 0; i < 3; ++i) {
      if (is_one_side(around.sides[i], around.sides[(i + 1) % 3])) return std::nullopt;
    }
    const std::optional<Vec3> place = meeting_place(around.sides);
    if (!place || glm::length(*place) > reach) return std::nullopt;
    if (!residual2_of_sides(around, *place, {0, 1, 2})) return std::nullopt;
    return middle + *place;
  }

  [[nodiscard]] bool has_corner(const Triangle& t, const Vec3& corner,
                                const std::vector<std::uint8_t>& is_feature) const {
    bool found = false;
    for (const std::uint32_t v : t) {
      table_.for_each_neighbor(
          v, [&](std::uint32_t w) { found = found || is_near(w, corner, is_feature, 2); });
    }
    return found;
  }

  [[nodiscard]] std::uint32_t longest_edge(std::uint32_t face) const {
    const auto length = [&](std::uint32_t c) {
      return glm::length(positions_[table_.head(c)] - positions_[table_.vertex(c)]);
    };
    std::uint32_t longest = 3 * face;
    for (const std::uint32_t c : {3 * face + 1, 3 * face + 2}) {
      if (length(c) > length(longest)) longest = c;
    }
    return longest;
  }

  std::vector<Vec3>& positions_;
  const PointGrid& cloud_;
  const SnapOptions& options_;
  double noise2_;  ///< mean square distance of points from the surface
  CornerTable table_;
  std::vector<VertexSurface> surfaces_;
  std::vector<Feature> features_;  ///< one a vertex; without sides except on edges
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
