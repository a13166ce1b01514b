#include "core/finish/places_near.h"

#include <unordered_map>

#include "core/base/cubes.h"

namespace rangezip {

PointGrid grid_of(std::span<const Vec3> places, double cell) {
  Box region;
  for (const Vec3& place : places)
    region.add(place);
  return {places, region, cell};
}

std::vector<Vec3> points_near(std::span<const Vec3> points, const PointGrid& places,
                              double radius) {
  const auto flags = flags_of(
      points.size(), [&](std::size_t i) { return places.has_point_within(points[i], radius); });
  std::vector<Vec3> near;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (flags[i] != 0) near.push_back(points[i]);
  }
  return near;
}

std::vector<Vec3> points_near(const PointGrid& cloud, const PointGrid& places, double radius) {
  const auto flags = flags_of(
      cloud.size(), [&](std::size_t i) { return places.has_point_within(cloud.point(i), radius); });
  std::vector<Vec3> near;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (flags[i] != 0) near.push_back(cloud.point(i));
  }
  return near;
}

std::vector<std::uint32_t> firsts_of_cubes(std::span<const Vec3> points, double side) {
  std::unordered_map<Cube, std::uint32_t, CubeHash> firsts;
  std::vector<std::uint32_t> first_of(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i)
    first_of[i] = firsts.try_emplace(cube_of(points[i], side), i).first->second;
  return first_of;
}

FacePart part_near(const TriangleMesh& mesh, const PointGrid& places, double radius) {
  return face_part(mesh, flags_of(mesh.triangles.size(), [&](std::size_t f) {
                     return places.has_point_within(mesh.positions[mesh.triangles[f][0]], radius);
                   }));
}

}  // namespace rangezip
