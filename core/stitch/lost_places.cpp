#include "core/stitch/lost_places.h"

#include <algorithm>

#include "core/mesh/coverage.h"

namespace rangezip {

namespace {

/// Places of the surface that is gone, and where they are in the image.
struct Places {
  std::vector<Vec3> positions;
  std::vector<Pixel> pixels;
};

Places places_of(const SeenMesh& before, const TriangleMesh& after, const FaceChanges& changes) {
  std::vector<std::uint8_t> is_done(before.mesh.positions.size(), 0);
  for (const Triangle& face : after.triangles) {
    for (const std::uint32_t v : face) {
      if (v < is_done.size() && after.positions[v] == before.mesh.positions[v]) is_done[v] = 1;
    }
  }
  Places places;
  for (const std::uint32_t f : changes.gone) {
    const Triangle& face = before.mesh.triangles[f];
    const auto has_image = [&](std::uint32_t v) { return before.image.has_image(v); };
    if (!std::all_of(face.begin(), face.end(), has_image)) continue;
    Vec3 sum{0.0};
    GridPoint image;
    for (const std::uint32_t v : face) {
      const GridPoint& p = before.image.points[v];
      sum += before.mesh.positions[v];
      image = {image.x + p.x, image.y + p.y};
      if (is_done[v] != 0) continue;
      is_done[v] = 1;
      places.positions.push_back(before.mesh.positions[v]);
      places.pixels.push_back(nearest_pixel(p));
    }
    places.positions.push_back(sum / 3.0);
    places.pixels.push_back(nearest_pixel({image.x / 3, image.y / 3}));
  }
  return places;
}

/// The faces in the box around the places.
TriangleMesh around(const TriangleMesh& mesh, const std::vector<Vec3>& places, double distance) {
  Box bounds;
  for (const Vec3& place : places)
    bounds.add(place);
  bounds.lower -= Vec3(distance);
  bounds.upper += Vec3(distance);
  TriangleMesh part;
  part.positions = mesh.positions;
  for (const Triangle& face : mesh.triangles) {
    Box box;
    for (const std::uint32_t v : face)
      box.add(mesh.positions[v]);
    bool meets = true;
    for (int axis = 0; axis < 3; ++axis) {
      meets =
          meets && box.lower[axis] <= bounds.upper[axis] && bounds.lower[axis] <= box.upper[axis];
    }
    if (meets) part.triangles.push_back(face);
  }
  remove_unused_vertices(part);
  return part;
}

}  // namespace

std::vector<Pixel> find_lost_places(const SeenMesh& before, const SeenMesh& after,
                                    const FaceChanges& changes, double distance) {
  const Places places = places_of(before, after.mesh, changes);
  if (places.positions.empty()) return {};
  const std::vector<std::uint8_t> covered =
      covered_points(places.positions, around(after.mesh, places.positions, distance), distance);
  std::vector<Pixel> lost;
  for (std::size_t i = 0; i < covered.size(); ++i) {
    if (covered[i] == 0) lost.push_back(places.pixels[i]);
  }
  return lost;
}

}  // namespace rangezip
