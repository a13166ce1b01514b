#include "core/reconstruct/coverage_report.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/base/parallel.h"
#include "core/finish/left_out_points.h"
#include "core/finish/papered_faces.h"
#include "core/finish/places_near.h"
#include "core/finish/point_grid.h"
#include "core/mesh/coverage.h"

namespace rangezip {

namespace {

/// In pixel sides: how far apart points of one place may lie.
constexpr double kReach = 2.0;
/// Fewer points together are outliers.
constexpr std::size_t kMinPoints = 10;
/// A smaller place of faces is closed over what any cloud leaves out here and there.
constexpr std::size_t kMinFaces = 10;
/// In pixel sides or spacings. Of randomly spread points one in a thousand has no other within
/// this.
constexpr double kSupportRadius = 1.5;

/// In square pixel sides: a surface that runs askew through a cube with such sides.
constexpr double kMostOfCube = 2.0;

double area_of_mesh(const TriangleMesh& mesh) {
  double area = 0.0;
  for (const Triangle& t : mesh.triangles)
    area += area_of_face(mesh.positions, t);
  return area;
}

/// Drops the places with fewer points, which stand last. @return how many points were in them
std::size_t drop_scattered(std::vector<Place>& places, std::size_t min_points) {
  std::size_t dropped = 0;
  while (!places.empty() && places.back().points < min_points) {
    dropped += places.back().points;
    places.pop_back();
  }
  return dropped;
}

double total_area(std::span<const Place> places) {
  double area = 0.0;
  for (const Place& place : places)
    area += place.area;
  return area;
}

/// What each of the points stands for: `area_per_point`, but no more than fits to where they are.
std::vector<double> areas_of_points(std::span<const Vec3> points, double area_per_point,
                                    double pixel_size) {
  const std::vector<std::uint32_t> firsts = firsts_of_cubes(points, pixel_size);
  std::vector<double> counts(points.size(), 0.0);
  for (const std::uint32_t first : firsts)
    counts[first] += 1.0;
  const double most = kMostOfCube * pixel_size * pixel_size;
  std::vector<double> areas(points.size());
  for (std::size_t i = 0; i < areas.size(); ++i)
    areas[i] = std::min(area_per_point, most / counts[firsts[i]]);
  return areas;
}

void report_uncovered(std::span<const Vec3> points, const std::vector<std::uint8_t>& is_covered,
                      const TriangleMesh& mesh, double area_per_point, double pixel_size,
                      CoverageReport& report) {
  std::vector<Vec3> uncovered;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (is_covered[i] == 0) uncovered.push_back(points[i]);
  }
  report.uncovered_points = uncovered.size();
  const std::vector<Vec3> left_out = left_out_points(points, uncovered, mesh, pixel_size);
  const std::vector<double> areas = areas_of_points(left_out, area_per_point, pixel_size);
  report.uncovered = places_of(left_out, areas, kReach * pixel_size);
  report.scattered_points =
      uncovered.size() - left_out.size() + drop_scattered(report.uncovered, kMinPoints);
  report.uncovered_area = total_area(report.uncovered);
}

/// The points around a mesh, sorted for looking within `radius`.
PointGrid grid_for_faces(std::span<const Vec3> points, const TriangleMesh& mesh, double radius) {
  const Box region = widened(bounds_of(mesh), radius);
  return {points, region, radius};
}

/// For each face whether a point lies within `radius` of its centroid.
std::vector<std::uint8_t> supported_faces(std::span<const Vec3> points, const TriangleMesh& mesh,
                                          double radius) {
  const PointGrid cloud = grid_for_faces(points, mesh, radius);
  std::vector<std::uint8_t> is_supported(mesh.triangles.size(), 0);
  constexpr std::size_t kFacesPerBlock = 4096;
  parallel_for(mesh.triangles.size(), kFacesPerBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      is_supported[f] =
          cloud.has_point_within(centroid_of(mesh.positions, mesh.triangles[f]), radius) ? 1 : 0;
    }
  });
  return is_supported;
}

/// Of the faces that are flagged, or of all others.
std::vector<Place> places_of_faces(const TriangleMesh& mesh, const std::vector<std::uint8_t>& flags,
                                   bool are_flagged, double reach) {
  std::vector<Vec3> centroids;
  std::vector<double> areas;
  for (std::size_t f = 0; f < flags.size(); ++f) {
    if ((flags[f] != 0) != are_flagged) continue;
    centroids.push_back(centroid_of(mesh.positions, mesh.triangles[f]));
    areas.push_back(area_of_face(mesh.positions, mesh.triangles[f]));
  }
  return places_of(centroids, areas, reach);
}

void report_unsupported(const TriangleMesh& mesh, const std::vector<std::uint8_t>& is_supported,
                        double pixel_size, CoverageReport& report) {
  report.unsupported = places_of_faces(mesh, is_supported, false, kReach * pixel_size);
  drop_scattered(report.unsupported, kMinFaces);
  report.unsupported_area = total_area(report.unsupported);
}

void report_papered(const SeenPoints& seen, const TriangleMesh& mesh, double pixel_size,
                    CoverageReport& report) {
  const std::vector<std::uint8_t> is_papered =
      papered_faces(mesh, grid_for_faces(seen.points, mesh, pixel_size), seen, pixel_size);
  report.papered = places_of_faces(mesh, is_papered, true, pixel_size);
  report.papered_area = total_area(report.papered);
}

}  // namespace

CoverageReport report_coverage(const SeenPoints& seen, const TriangleMesh& mesh,
                               double pixel_size) {
  const std::span<const Vec3> points = seen.points;
  const std::vector<std::uint8_t> is_covered = covered_points(points, mesh, pixel_size);
  const auto covered =
      static_cast<double>(std::count(is_covered.begin(), is_covered.end(), std::uint8_t{1}));
  CoverageReport report;
  if (points.empty()) return report;
  report.share = covered / static_cast<double>(points.size());
  const double area_per_point = covered > 0.0 ? area_of_mesh(mesh) / covered : 0.0;
  report_uncovered(points, is_covered, mesh, area_per_point, pixel_size, report);
  if (mesh.empty()) return report;
  const double radius = kSupportRadius * std::max(pixel_size, std::sqrt(area_per_point));
  report_unsupported(mesh, supported_faces(points, mesh, radius), pixel_size, report);
  if (!seen.votes.empty()) report_papered(seen, mesh, pixel_size, report);
  return report;
}

}  // namespace rangezip
