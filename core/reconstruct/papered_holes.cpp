#include "core/reconstruct/papered_holes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>

#include "core/base/sphere_set.h"
#include "core/base/symmetric_eigen.h"
#include "core/finish/components.h"
#include "core/finish/corner_table.h"
#include "core/finish/left_out_points.h"
#include "core/finish/places_near.h"
#include "core/finish/point_grid.h"
#include "core/finish/unsupported_faces.h"
#include "core/mesh/coverage.h"
#include "core/mesh/places.h"

namespace rangezip {
namespace {

/// In h: faces of one place are no farther apart.
constexpr double kTogether = 1.0;
/// In square h: less is left without a point by chance.
constexpr double kMinArea = 1.0;
/// In h: how near to the faces the wall of a hole is.
constexpr double kWallReach = 2.0;
/// In h, and points: the wall of a hole, but no sharp edge that scans cut off, is so far from the
/// mesh in places.
constexpr double kDeep = 0.6;
constexpr std::size_t kMinDeep = 5;
/// Of the points there.
constexpr double kMaxWallShare = 0.5;
/// In h: in which points tell the noise.
constexpr double kNoiseRadius = 1.0;
/// In h: how much farther than the faces without points a place reaches.
constexpr double kBent = 1.5;
/// In h: points farther from all such faces belong to no place.
constexpr double kNear = 3.0;
/// Of its faces: more are not to go. Less than so many faces are a scrap.
constexpr double kMostOfComponent = 0.75;
constexpr std::size_t kMinComponent = 100;
/// In h: what lies beyond the mesh.
constexpr double kRegionMargin = 6.0;

/// Faces by their centroids.
struct Faces {
  std::vector<Vec3> centers;
  std::vector<double> areas;
};

Faces faces_without_points(const TriangleMesh& mesh, const PointGrid& cloud, double h) {
  const std::vector<std::uint8_t> is_bare = flags_of(mesh.triangles.size(), [&](std::size_t f) {
    return !is_supported(cloud, mesh, mesh.triangles[f], h, kCloseSupport);
  });
  Faces bare;
  for (std::size_t f = 0; f < is_bare.size(); ++f) {
    if (is_bare[f] == 0) continue;
    bare.centers.push_back(centroid_of(mesh.positions, mesh.triangles[f]));
    bare.areas.push_back(area_of_face(mesh.positions, mesh.triangles[f]));
  }
  return bare;
}

std::vector<Vec3> points_in(const Sphere& sphere, const PointGrid& points) {
  std::vector<Vec3> inside;
  points.for_each_near(sphere.center, sphere.radius, [&](const Vec3& offset) {
    if (glm::dot(offset, offset) <= sphere.radius * sphere.radius)
      inside.push_back(sphere.center + offset);
  });
  return inside;
}

/// Standard deviation of the points around a place from the plane through them, model units.
double noise_at(const Vec3& place, const PointGrid& points, double radius) {
  constexpr double kOfPlane = 3.0;  // degrees of freedom
  const std::vector<Vec3> around = points_in({place, radius}, points);
  const auto count = static_cast<double>(around.size());
  if (count <= kOfPlane) return 0.0;
  Vec3 mean{0.0};
  for (const Vec3& p : around)
    mean += p / count;
  Mat3 moments{0.0};
  for (const Vec3& p : around)
    moments += glm::outerProduct(p - mean, p - mean);
  const double least = eigen_of_symmetric(moments).values[0];
  return std::sqrt(std::max(0.0, least) / (count - kOfPlane));
}

/// Whether the points of a wall lie on a clean surface. A quarter of them tell: those at its edges
/// lie on no plane.
bool is_clean(const std::vector<Vec3>& wall, const PointGrid& points, double h) {
  std::vector<double> noise;
  noise.reserve(wall.size());
  for (const Vec3& p : wall)
    noise.push_back(noise_at(p, points, kNoiseRadius * h));
  const auto quarter = noise.begin() + static_cast<std::ptrdiff_t>(noise.size() / 4);
  std::nth_element(noise.begin(), quarter, noise.end());
  return *quarter <= kMaxHoleNoise * h;
}

/// Whether so much of a component lies in the places that hardly anything would be left of it.
bool hold_a_component(const SphereSet& places, const TriangleMesh& mesh) {
  const std::vector<std::uint32_t> component =
      components_of(CornerTable(mesh.triangles, mesh.positions.size()));
  const std::vector<std::size_t> sizes = component_sizes(component);
  std::vector<std::size_t> inside(sizes.size(), 0);
  for (std::size_t f = 0; f < component.size(); ++f) {
    if (places.contains(centroid_of(mesh.positions, mesh.triangles[f]))) ++inside[component[f]];
  }
  for (std::size_t c = 0; c < sizes.size(); ++c) {
    const double most = kMostOfComponent * static_cast<double>(sizes[c]);
    if (sizes[c] >= kMinComponent && static_cast<double>(inside[c]) > most) return true;
  }
  return false;
}

}  // namespace

PaperedHoles find_papered_holes(std::span<const Vec3> points, const TriangleMesh& mesh,
                                const PaperedHoleOptions& options) {
  if (mesh.empty() || points.empty()) return {};
  const double h = options.pixel_size;
  const Box region = widened(bounds_of(mesh), kRegionMargin * h);
  const Faces bare =
      faces_without_points(mesh, PointGrid(points, region, kCloseSupport.pixels * h), h);
  if (bare.centers.empty()) return {};
  const std::vector<Vec3> near = points_near(points, PointGrid(bare.centers, region, h), kNear * h);
  const PointGrid around(near, region, 0.5 * h);
  const std::vector<Vec3> off = left_out_points(near, mesh, options.off_mesh * h);
  const PointGrid left_out(off, region, 0.5 * h);
  const PointGrid deep(options.off_mesh < kDeep ? points_off(off, mesh, kDeep * h) : off, region,
                       0.5 * h);

  PaperedHoles holes;
  for (const Place& place : places_of(bare.centers, bare.areas, kTogether * h)) {
    if (place.area < kMinArea * h * h) continue;
    const Sphere reach{place.center, place.radius + kWallReach * h};
    const std::vector<Vec3> wall = points_in(reach, left_out);
    const auto most = kMaxWallShare * static_cast<double>(points_in(reach, around).size());
    if (wall.size() < options.min_wall || static_cast<double>(wall.size()) > most) continue;
    if (points_in(reach, deep).size() < kMinDeep) continue;
    if (is_clean(wall, around, h)) holes.places.push_back({place.center, place.radius + kBent * h});
  }
  const SphereSet set(holes.places);
  std::copy_if(near.begin(), near.end(), std::back_inserter(holes.points),
               [&](const Vec3& p) { return set.contains(p); });
  return holes;
}

std::optional<PaperedHoles> find_holes_for_fronts(std::span<const Vec3> points,
                                                  const TriangleMesh& mesh, double pixel_size) {
  PaperedHoles holes = find_papered_holes(points, mesh, of_sparse_points(pixel_size));
  if (hold_a_component(SphereSet(holes.places), mesh)) return std::nullopt;
  return holes;
}

}  // namespace rangezip
