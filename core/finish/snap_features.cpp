#include "core/finish/snap_features.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/parallel.h"
#include "core/finish/feature_cleanup.h"
#include "core/finish/feature_mesh.h"
#include "core/finish/feature_place.h"
#include "core/finish/feature_sides.h"
#include "core/finish/refit_sides.h"
#include "core/finish/relax_features.h"
#include "core/finish/split_features.h"
#include "core/finish/vertex_geometry.h"

namespace rangezip {
namespace {

// Lengths are in h, angles as cosines.
constexpr int kRings = 4;              // where clean surfaces are looked for
constexpr double kWeightRadius = 4.5;  // of surfaces in the mean of a side
constexpr double kFaceCosine = 0.5;    // between a face and its side
constexpr double kRefitNoise = 0.1;    // more tells hardly where a side is from a few points
constexpr double kNarrowNoise = 0.05;  // more, and the nearest points do not tell what is clean
constexpr int kLateRounds = 2;         // next to features that are there
constexpr int kTidyRounds = 3;
constexpr double kPixelPerEdge = 0.9;  // two triangles a pixel have edges of 1.1 of its side
constexpr std::size_t kVerticesPerBlock = 256;

/// What a place on a feature is to show.
struct Demands {
  std::size_t surfaces = 0;  ///< clean ones around
  double tolerance = 0.0;    ///< Surroundings::tolerance
  /// Root mean square of what points are off a smooth surface, beyond the noise. At an edge of 30
  /// degrees it is 0.03, and 0.008 is the limit of a clean surface. Of what is between that and
  /// 0.02 one vertex in a thousand is on a feature, and few of those are not found from beside it.
  double roughness = 0.0;
};
constexpr Demands kWideDemands{6, kProofTolerance, 0.014};
constexpr Demands kNarrowDemands{3, 0.025, 0.02};

/// Where a vertex goes.
struct Snap {
  Vec3 move{0.0};
  std::uint8_t feature = 0;          ///< 1 on an edge, 2 at a corner, 0 on a side
  std::vector<FeatureSide> meeting;  ///< the sides that meet there, relative to the old place
  VertexSurface surface;             ///< of the side
};

class Snapper {
 public:
  Snapper(TriangleMesh& mesh, const PointGrid& cloud, const SnapOptions& options)
      : mesh_(mesh), cloud_(cloud, options), options_(options) {}

  SnapReport run(const Progress& progress) {
    fit_surfaces();
    progress.check_stop();
    SnapReport report;
    const std::vector<Vec3> before = mesh_.positions;
    snap([&](std::uint32_t v) { return first_snap_of(v); });
    if (cloud_.noise() <= kNarrowNoise * options_.pixel_size) {
      fit_narrow_surfaces();
      progress.check_stop();
      snap([&](std::uint32_t v) { return first_snap_of(v); });
    }
    for (int round = 0; round < kLateRounds; ++round)
      snap([&](std::uint32_t v) { return late_snap_of(v); });
    report.split_edges = split_crossing_edges(mesh_, cloud_);
    report.snapped_vertices =
        mesh_.is_feature.size() -
        static_cast<std::size_t>(std::count(mesh_.is_feature.begin(), mesh_.is_feature.end(), 0));
    progress.check_stop();
    if (report.snapped_vertices == 0) {
      mesh_.positions = before;  // no edge anywhere: then nothing was to be sharp
      return report;
    }
    for (int round = 0; round < kTidyRounds; ++round) {
      if (round > 0) report.split_edges += split_crossing_edges(mesh_, cloud_);
      const FeatureCleanupReport cleaned =
          clean_features(mesh_.table, mesh_.positions, mesh_.is_feature, pixel_of_edges(),
                         options_.sizes, options_.is_kept);
      report.collapsed_edges += cleaned.collapsed_edges;
      report.flipped_edges += cleaned.flipped_edges;
      take_back_lone();
      report.split_edges += split_cut_corners(mesh_, cloud_);
      relax_features(
          mesh_.table, mesh_.positions, mesh_.is_feature,
          {.place_on = [&](std::uint32_t v, const Vec3& target) { return place_on(v, target); },
           .may_change = [&](std::uint32_t v) { return !is_kept(v); },
           .may_face = [&](std::uint32_t v, const Vec3& d) { return may_face(v, d); }});
    }
    return report;
  }
  [[nodiscard]] std::vector<Triangle> triangles() const { return mesh_.table.triangles(); }

 private:
  [[nodiscard]] const Vec3& at(std::uint32_t vertex) const { return mesh_.positions[vertex]; }

  [[nodiscard]] bool is_kept(std::uint32_t v) const {
    return v < options_.is_kept.size() && options_.is_kept[v] != 0;
  }

  /// h, or what it would be for scans that give triangles as small as these.
  [[nodiscard]] double pixel_of_edges() const {
    const double h = options_.pixel_size;
    return options_.edge > 0.0 ? std::min(h, kPixelPerEdge * options_.edge) : h;
  }

  void fit_surfaces() {
    parallel_for(mesh_.positions.size(), kVerticesPerBlock,
                 [&](std::size_t begin, std::size_t end) {
                   for (auto v = static_cast<std::uint32_t>(begin); v < end; ++v)
                     mesh_.surfaces[v] =
                         cloud_.surface_at(at(v), vertex_normal(mesh_.table, mesh_.positions, v));
                 });
  }

  /// Surfaces of the nearest points where those farther away are no surface, between edges that are
  /// close to each other. Of such there are few, and they know less: so from here on fewer are
  /// asked for, and proofs are to be better.
  void fit_narrow_surfaces() {
    narrow_surfaces_.resize(mesh_.positions.size());
    demands_ = kNarrowDemands;
    parallel_for(
        mesh_.positions.size(), kVerticesPerBlock, [&](std::size_t begin, std::size_t end) {
          for (auto v = static_cast<std::uint32_t>(begin); v < end; ++v) {
            if (mesh_.surfaces[v].is_clean || mesh_.is_feature[v] != 0) continue;
            narrow_surfaces_[v] =
                cloud_.narrow_surface_at(at(v), vertex_normal(mesh_.table, mesh_.positions, v));
          }
        });
  }

  /// The wide one, or else the narrow one, if that is clean.
  [[nodiscard]] const VertexSurface* clean_surface_at(std::uint32_t v) const {
    if (mesh_.surfaces[v].is_clean) return &mesh_.surfaces[v];
    const bool is_narrow = v < narrow_surfaces_.size() && narrow_surfaces_[v].is_clean;
    return is_narrow ? &narrow_surfaces_[v] : nullptr;
  }

  /// Moves what can be moved of what has not been, and flags the vertices that are on features now.
  template <class SnapOf>
  void snap(const SnapOf& snap_of_vertex) {
    std::vector<std::optional<Snap>> snaps(mesh_.positions.size());
    parallel_for(mesh_.positions.size(), kVerticesPerBlock,
                 [&](std::size_t begin, std::size_t end) {
                   for (auto v = static_cast<std::uint32_t>(begin); v < end; ++v) {
                     if (!mesh_.surfaces[v].is_clean && mesh_.is_feature[v] == 0 &&
                         !mesh_.table.is_boundary(v) && !is_kept(v))
                       snaps[v] = snap_of_vertex(v);
                   }
                 });
    for (std::uint32_t v = 0; v < snaps.size(); ++v) {
      if (!snaps[v]) continue;
      mesh_.features[v] = {at(v), std::move(snaps[v]->meeting)};
      mesh_.positions[v] += snaps[v]->move;
      mesh_.is_feature[v] = snaps[v]->feature;
      if (snaps[v]->feature == 0) mesh_.surfaces[v] = snaps[v]->surface;
    }
  }

  /// Where the sides of the surfaces around meet as they are, or fitted to the points.
  [[nodiscard]] std::optional<Snap> snap_of(std::uint32_t v,
                                            std::vector<FeatureSide> surfaces) const {
    if (surfaces.size() < demands_.surfaces) return std::nullopt;
    const Vec3& origin = at(v);
    Surroundings around =
        cloud_.surroundings(origin, sides_of(std::move(surfaces), cloud_.step_at(origin)));
    if (around.sides.empty()) return std::nullopt;
    around.tolerance = demands_.tolerance;
    const double edge = mean_edge_at(v);
    FeaturePlace found = find_feature_place(around, edge, mesh_.surfaces[v].residual2);
    if (found.count == 0 && around.sides.size() > 1 &&
        cloud_.noise() <= kRefitNoise * around.pixel_size) {
      around.sides = refit_sides(around);
      found = find_feature_place(around, edge, mesh_.surfaces[v].residual2);
    }
    if (found.count == 0) return std::nullopt;
    Snap snap{found.place, static_cast<std::uint8_t>(found.count - 1), {}, {}};
    const FeatureSide& first = around.sides[found.sides[0]];
    if (found.count == 1) snap.surface = surface_of(first, at(v), found.place);
    if (found.count == 2) snap.meeting = {first, around.sides[found.sides[1]]};
    return snap;
  }

  /// With the surfaces around.
  [[nodiscard]] std::optional<Snap> first_snap_of(std::uint32_t v) const {
    const double least = demands_.roughness * cloud_.h_at(at(v));
    if (mesh_.surfaces[v].residual2 - cloud_.noise2() < least * least) return std::nullopt;
    return snap_of(v, clean_surfaces_around(v));
  }

  /// With the sides of the features next to it, which are proved.
  [[nodiscard]] std::optional<Snap> late_snap_of(std::uint32_t v) const {
    std::vector<FeatureSide> sides;
    mesh_.table.for_each_neighbor(v, [&](std::uint32_t w) {
      if (mesh_.is_feature[w] == 0) return;
      const Vec3 d = at(v) - mesh_.features[w].origin;
      const double weight = weight_of(d, v);
      if (!(weight > 0.0)) return;
      for (const FeatureSide& side : mesh_.features[w].sides)
        sides.push_back({side.height.seen_from(d), weight});
    });
    if (sides.empty()) return std::nullopt;
    std::vector<FeatureSide> surfaces = clean_surfaces_around(v);
    surfaces.insert(surfaces.end(), sides.begin(), sides.end());
    return snap_of(v, std::move(surfaces));
  }

  /// Of a surface so far from a vertex in the mean of a side.
  [[nodiscard]] double weight_of(const Vec3& d, std::uint32_t v) const {
    const double radius = kWeightRadius * cloud_.h_at(at(v));
    const double nearness = std::max(0.0, 1.0 - glm::dot(d, d) / (radius * radius));
    const double squared = nearness * nearness;
    return squared * squared;
  }

  [[nodiscard]] VertexSurface surface_of(const FeatureSide& side, const Vec3& origin,
                                         const Vec3& place) const {
    return {.center = origin + place,
            .normal = unit_or_z(side.height.slope_at(place)),
            .bending = side.height.bending,
            .residual2 = cloud_.noise2(),
            .is_clean = true};
  }

  [[nodiscard]] std::vector<FeatureSide> clean_surfaces_around(std::uint32_t v) const {
    std::vector<std::uint32_t> seen{v};
    std::vector<FeatureSide> surfaces;
    std::size_t begin = 0;
    for (int ring = 0; ring < kRings; ++ring) {
      const std::size_t end = seen.size();
      for (; begin < end; ++begin) {
        mesh_.table.for_each_neighbor(seen[begin], [&](std::uint32_t w) {
          if (std::find(seen.begin(), seen.end(), w) != seen.end()) return;
          seen.push_back(w);
          const VertexSurface* surface = clean_surface_at(w);
          if (surface == nullptr) return;
          const double weight = weight_of(surface->center - at(v), v);
          if (weight > 0.0) surfaces.push_back(seen_from(at(v), *surface, weight));
        });
      }
    }
    return surfaces;
  }

  [[nodiscard]] double mean_edge_at(std::uint32_t v) const {
    double sum = 0.0;
    int count = 0;
    mesh_.table.for_each_neighbor(v, [&](std::uint32_t w) {
      sum += glm::length(at(w) - at(v));
      ++count;
    });
    return count > 0 ? sum / count : 0.0;
  }

  /// Vertices on a feature on their own: features are lines.
  void take_back_lone() {
    for (std::uint32_t v = 0; v < mesh_.is_feature.size(); ++v) {
      if (mesh_.is_feature[v] == 0 || mesh_.table.corner_of(v) == CornerTable::kNone) continue;
      bool is_lone = true;
      mesh_.table.for_each_neighbor(
          v, [&](std::uint32_t w) { is_lone = is_lone && mesh_.is_feature[w] == 0; });
      if (!is_lone) continue;
      mesh_.positions[v] = mesh_.features[v].origin;
      mesh_.is_feature[v] = 0;
      mesh_.features[v] = {};
    }
  }

  /// See VertexSides.
  [[nodiscard]] std::optional<Vec3> place_on(std::uint32_t v, const Vec3& target) const {
    if (is_kept(v)) return std::nullopt;
    std::vector<FeatureSide> sides;
    for (const FeatureSide& side : mesh_.features[v].sides)
      sides.push_back({side.height.seen_from(target - mesh_.features[v].origin), side.weight});
    if (sides.empty() && mesh_.surfaces[v].is_clean)
      sides.push_back(seen_from(target, mesh_.surfaces[v], 1.0));
    if (sides.empty()) return std::nullopt;
    const std::optional<Vec3> place = meeting_place(sides);
    if (!place || glm::length(*place) > cloud_.h_at(target)) return std::nullopt;
    return target + *place;
  }

  /// See VertexSides.
  [[nodiscard]] bool may_face(std::uint32_t v, const Vec3& direction) const {
    const Feature& feature = mesh_.features[v];
    if (feature.sides.empty())
      return !mesh_.surfaces[v].is_clean ||
             has_cosine(mesh_.surfaces[v].normal, direction, kFaceCosine);
    return std::any_of(feature.sides.begin(), feature.sides.end(), [&](const FeatureSide& side) {
      return has_cosine(side.height.slope, direction, kFaceCosine);
    });
  }

  FeatureMesh mesh_;
  std::vector<VertexSurface> narrow_surfaces_;  ///< one per vertex, or empty: not fitted
  Demands demands_ = kWideDemands;
  FeatureCloud cloud_;
  const SnapOptions& options_;
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
