#pragma once

#include <cstdint>
#include <vector>

#include "core/base/geometry.h"
#include "core/finish/corner_table.h"
#include "core/finish/feature_place.h"
#include "core/finish/feature_sides.h"
#include "core/finish/point_grid.h"
#include "core/finish/snap_features.h"
#include "core/finish/surface_fit.h"
#include "core/mesh/triangle_mesh.h"

namespace rangezip {

/// The surface around a vertex.
struct VertexSurface {
  Vec3 center{0.0};
  Vec3 normal{0.0};
  Mat3 bending{0.0};
  double residual2 = 0.0;  ///< mean square distance of the points; h^2 where there is no surface
  bool is_clean = false;   ///< the points lie on it, but for noise
};

/// What a surface is over a place, relative to that place.
[[nodiscard]] FeatureSide seen_from(const Vec3& place, const VertexSurface& surface, double weight);

/// The sides that meet in a vertex on a feature, relative to a place.
struct Feature {
  Vec3 origin{0.0};  ///< the place: where the vertex was, or next to where it is
  std::vector<FeatureSide> sides;
};

/// A mesh, what is known at each of its vertices, and which of these are on features. Positions are
/// those of the mesh, which is to outlive this; its triangles are made anew from the table.
struct FeatureMesh {
  std::vector<Vec3>& positions;
  CornerTable table;
  std::vector<VertexSurface> surfaces;
  std::vector<Feature> features;         ///< without sides except on edges
  std::vector<std::uint8_t> is_feature;  ///< 1 on an edge, 2 at a corner, 0 elsewhere

  explicit FeatureMesh(TriangleMesh& mesh);

  /// Splits the edge of a corner at a place that is on a feature: 1 an edge, 2 a corner.
  void split(std::uint32_t corner, const Vec3& place, Feature feature, std::uint8_t kind);
};

/// The cloud around the places of a mesh, with the lengths that count there.
class FeatureCloud {
 public:
  /// Both are to outlive this.
  FeatureCloud(const PointGrid& cloud, const SnapOptions& options)
      : cloud_(cloud), options_(options) {}

  /// Mean square distance of points from the surface.
  [[nodiscard]] double noise2() const { return options_.fit.noise * options_.fit.noise; }
  /// Its root.
  [[nodiscard]] double noise() const { return options_.fit.noise; }
  /// h, in proportion to the sizes of triangles there.
  [[nodiscard]] double h_at(const Vec3& place) const {
    return options_.pixel_size * options_.sizes.at(place);
  }
  /// Surfaces so far apart are two sides.
  [[nodiscard]] double step_at(const Vec3& place) const;

  [[nodiscard]] Surroundings surroundings(const Vec3& place, std::vector<FeatureSide> sides) const;

  /// The surface around a vertex: clean if the scatter of the points is hardly more than noise.
  /// None is found where they are few, or it looks more than 37 degrees away from the mesh.
  [[nodiscard]] VertexSurface surface_at(const Vec3& place, const Vec3& normal) const;

  /// The same of the nearest points only, so that it may be clean between edges 2.4 h apart. Clean
  /// only where it hardly bends: a rounded edge seen so near is no side of one.
  [[nodiscard]] VertexSurface narrow_surface_at(const Vec3& place, const Vec3& normal) const;

 private:
  [[nodiscard]] VertexSurface surface_of(const MeasuredFit& measured, const Vec3& place,
                                         const Vec3& normal) const;
  [[nodiscard]] SurfaceWindow window_at(const Vec3& place) const;
  [[nodiscard]] MeasuredFit measured_at(const Vec3& place, const Vec3& normal) const;

  const PointGrid& cloud_;
  const SnapOptions& options_;
};

}  // namespace rangezip
