#include "core/finish/feature_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace rangezip {
namespace {

// Lengths are in h.
constexpr double kFitRadius = 1.5;
constexpr double kFitRadiusShare = 0.7;  // of the radius that the noise demands, if that is more
constexpr double kFitHeight = 1.2;
constexpr double kNarrowRadius = 1.2;
constexpr double kNarrowBending = 0.25;  // per h
constexpr int kMinFitPoints = 12;
constexpr std::array kWiderWindows{1.0, 1.3, 1.7};  // where points are few
constexpr double kCleanResidual = 0.008;  // of the points about a clean surface, beyond the noise
constexpr double kSureness = 3.0;         // standard deviations
constexpr int kFitTerms = 6;
constexpr double kMinCosine = 0.8;  // between the surface and the mesh
constexpr double kStep = 0.3;       // beyond the noise

}  // namespace

FeatureSide seen_from(const Vec3& place, const VertexSurface& surface, double weight) {
  const Vec3 d = place - surface.center;
  const Vec3 bent = surface.bending * d;
  return {{glm::dot(surface.normal, d) - 0.5 * glm::dot(d, bent), surface.normal - bent,
           surface.bending},
          weight};
}

FeatureMesh::FeatureMesh(TriangleMesh& mesh)
    : positions(mesh.positions),
      table(mesh.triangles, mesh.positions.size()),
      surfaces(mesh.positions.size()),
      features(mesh.positions.size()),
      is_feature(mesh.positions.size(), 0) {}

void FeatureMesh::split(std::uint32_t corner, const Vec3& place, Feature feature,
                        std::uint8_t kind) {
  table.split_edge(corner);
  positions.push_back(place);
  surfaces.emplace_back();
  features.push_back(std::move(feature));
  is_feature.push_back(kind);
}

double FeatureCloud::step_at(const Vec3& place) const {
  return kStep * h_at(place) + kSureness * noise();
}

Surroundings FeatureCloud::surroundings(const Vec3& place, std::vector<FeatureSide> sides) const {
  return {cloud_, h_at(place), window_at(place).radius, noise2(), place, std::move(sides)};
}

VertexSurface FeatureCloud::surface_at(const Vec3& place, const Vec3& normal) const {
  return surface_of(measured_at(place, normal), place, normal);
}

VertexSurface FeatureCloud::narrow_surface_at(const Vec3& place, const Vec3& normal) const {
  const double h = h_at(place);
  VertexSurface surface =
      surface_of(measure_surface(cloud_, place, normal, {kNarrowRadius * h, kFitHeight * h, 0.0}),
                 place, normal);
  surface.is_clean = surface.is_clean && frobenius_norm(surface.bending) * h < kNarrowBending;
  return surface;
}

VertexSurface FeatureCloud::surface_of(const MeasuredFit& measured, const Vec3& place,
                                       const Vec3& normal) const {
  const double h = h_at(place);
  const auto& [fit, scatter] = measured;
  if (!fit.is_found || fit.count < kMinFitPoints || !(glm::dot(fit.normal, normal) > kMinCosine))
    return {.residual2 = h * h};
  // Of pure noise, hardly a mean square is larger.
  const double most_noise = 1.0 + kSureness * std::sqrt(2.0 / (fit.count - kFitTerms));
  const double limit = kCleanResidual * h;
  return {.center = fit.foot,
          .normal = fit.normal,
          .bending = fit.bending,
          .residual2 = scatter.noise2,
          .is_clean = scatter.noise2 < limit * limit + most_noise * noise2()};
}

SurfaceWindow FeatureCloud::window_at(const Vec3& place) const {
  const SurfaceWindow& demanded = options_.fit.window;
  const double h = h_at(place);
  return {std::max(kFitRadius * h, kFitRadiusShare * demanded.radius),
          std::max(kFitHeight * h, demanded.height), 0.0};
}

/// Where points are few, of a wider window.
MeasuredFit FeatureCloud::measured_at(const Vec3& place, const Vec3& normal) const {
  const SurfaceWindow window = window_at(place);
  MeasuredFit measured;
  for (const double wider : kWiderWindows) {
    measured = measure_surface(cloud_, place, normal, {wider * window.radius, window.height, 0.0});
    if (measured.fit.is_found && measured.fit.count >= kMinFitPoints) break;
  }
  return measured;
}

}  // namespace rangezip
