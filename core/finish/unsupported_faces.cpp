#include "core/finish/unsupported_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/base/parallel.h"
#include "core/finish/clean_topology.h"

namespace rangezip {
namespace {

/// In h: how far from a face the points next to it may be.
constexpr double kFarthest = 6.0;
constexpr double kUsual = 1.5;          ///< in h: mostly they are nearer than this
constexpr std::size_t kNeighbors = 16;  ///< that tell the spacing, as in core/plan/spacing.h
/// No point of a surface is as far from its points.
constexpr SupportReach kBeyondDoubt{.pixels = 1.25, .spacings = 2.0};
constexpr std::size_t kGrain = 256;
constexpr double kPi = 3.14159265358979323846;

/// The nearest point, if there is one within `radius`.
std::optional<Vec3> nearest_within(const PointGrid& cloud, const Vec3& place, double radius) {
  std::optional<Vec3> nearest;
  double least = radius * radius;
  cloud.for_each_near(place, radius, [&](const Vec3& offset) {
    const double squared = glm::dot(offset, offset);
    if (squared > least) return;
    least = squared;
    nearest = place + offset;
  });
  return nearest;
}

/// The nearest point, if there is one within kFarthest.
std::optional<Vec3> nearest_point(const PointGrid& cloud, const Vec3& place, double pixel_size) {
  std::optional<Vec3> nearest = nearest_within(cloud, place, kUsual * pixel_size);
  return nearest ? nearest : nearest_within(cloud, place, kFarthest * pixel_size);
}

/// Mean distance of neighbours on the surface around a point, or nothing if they are farther apart
/// than `radius` lets see.
std::optional<double> spacing_at(const PointGrid& cloud, const Vec3& point, double radius) {
  std::vector<double> squares;
  cloud.for_each_near(point, radius,
                      [&](const Vec3& offset) { squares.push_back(glm::dot(offset, offset)); });
  if (squares.size() <= kNeighbors) return std::nullopt;  // the point itself is among them
  const auto last = squares.begin() + kNeighbors;
  std::nth_element(squares.begin(), last, squares.end());
  return std::sqrt(*last * kPi / static_cast<double>(kNeighbors));
}

/// Whether spacing_at() a point, if it is told, is at least `spacing`: asks fewer points.
bool is_spaced(const PointGrid& cloud, const Vec3& point, double spacing, double radius) {
  const double distance = spacing * std::sqrt(static_cast<double>(kNeighbors) / kPi);
  std::size_t nearer = 0;
  cloud.for_each_near(point, std::min(distance, radius), [&](const Vec3& offset) {
    nearer += glm::dot(offset, offset) < distance * distance ? 1 : 0;
  });
  return nearer <= kNeighbors;  // the point itself is among them
}

bool has_long_side(const TriangleMesh& mesh, const Triangle& face, double length) {
  const Vec3 &a = mesh.positions[face[0]], &b = mesh.positions[face[1]],
             &c = mesh.positions[face[2]];
  const double longest =
      std::max({glm::dot(b - a, b - a), glm::dot(c - b, c - b), glm::dot(a - c, a - c)});
  return longest > length * length;
}

/// Drops the faces that `is_dropped` names, asked in parallel. @return how many went
template <class IsDropped>
std::size_t drop_faces(TriangleMesh& mesh, const IsDropped& is_dropped) {
  std::vector<std::uint8_t> goes(mesh.triangles.size(), 0);
  parallel_for(goes.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f)
      goes[f] = is_dropped(mesh.triangles[f]) ? 1 : 0;
  });
  remove_triangles(mesh.triangles, goes);
  if (mesh.triangles.size() < goes.size()) clean_topology(mesh);
  return goes.size() - mesh.triangles.size();
}

}  // namespace

bool is_supported(const PointGrid& cloud, const Vec3& place, double pixel_size,
                  const SupportReach& reach) {
  if (cloud.has_point_within(place, reach.pixels * pixel_size)) return true;
  const std::optional<Vec3> nearest = nearest_point(cloud, place, pixel_size);
  if (!nearest) return false;
  return is_spaced(cloud, *nearest, glm::length(*nearest - place) / reach.spacings,
                   kFarthest * pixel_size);
}

bool is_supported(const PointGrid& cloud, const TriangleMesh& mesh, const Triangle& face,
                  double pixel_size, const SupportReach& reach) {
  const Vec3 &a = mesh.positions[face[0]], &b = mesh.positions[face[1]],
             &c = mesh.positions[face[2]];
  const std::array<Vec3, 4> places{(a + b + c) / 3.0, 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)};
  return std::all_of(places.begin(), places.end(), [&](const Vec3& place) {
    return is_supported(cloud, place, pixel_size, reach);
  });
}

std::optional<double> spacing_near(const PointGrid& cloud, const Vec3& place, double pixel_size) {
  const std::optional<Vec3> nearest = nearest_point(cloud, place, pixel_size);
  return nearest ? spacing_at(cloud, *nearest, kFarthest * pixel_size) : std::nullopt;
}

std::size_t drop_unsupported_faces(TriangleMesh& mesh, std::span<const Vec3> cloud,
                                   double pixel_size) {
  if (cloud.empty() || mesh.empty()) return 0;
  const Box region = widened(bounds_of(mesh), kFarthest * pixel_size);
  const PointGrid points(cloud, region, kFaceSupport.pixels * pixel_size);
  const double long_side = 2.0 * kFaceSupport.pixels * pixel_size;
  const std::size_t dropped = drop_faces(mesh, [&](const Triangle& face) {
    return has_long_side(mesh, face, long_side) &&
           !is_supported(points, mesh, face, pixel_size, kFaceSupport);
  });
  remove_unused_vertices(mesh);
  return dropped;
}

std::size_t drop_faces_in_air(TriangleMesh& mesh, const PointGrid& cloud, double pixel_size) {
  if (cloud.empty()) return 0;
  return drop_faces(mesh, [&](const Triangle& face) {
    return !is_supported(cloud, centroid_of(mesh.positions, face), pixel_size, kBeyondDoubt);
  });
}

}  // namespace rangezip
