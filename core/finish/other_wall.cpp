#include "core/finish/other_wall.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/finish/hole_filling.h"
#include "core/mesh/coverage.h"

namespace rangezip {
namespace {

/// In h: places nearer to the loop tell nothing, the faces beside it are near.
constexpr double kFromLoop = 0.35;
constexpr std::size_t kFewestPlaces = 3;
/// In h: how near a place has points that the mesh does not show, and how far from it these are.
constexpr double kNear = 0.5;
constexpr double kOffMesh = 0.25;
constexpr double kOffMeshPerNoise = 3.0;
/// Of the places, and of the points near them: the fill itself may bulge away from the wall. Around
/// the end of an open sheet both are under 0.12, or the points are few.
constexpr double kShown = 0.2;

double distance_to(const std::vector<Vec3>& loop, const Vec3& p) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec3 &a = loop[i], along = loop[(i + 1) % loop.size()] - a;
    const double squared = glm::dot(along, along);
    const double t = squared > 0.0 ? std::clamp(glm::dot(p - a, along) / squared, 0.0, 1.0) : 0.0;
    least = std::min(least, glm::length(p - a - t * along));
  }
  return least;
}

/// Centroids of the fill's faces that are not beside the loop.
std::vector<Vec3> places_inside(const std::vector<Vec3>& positions, const HoleFill& fill,
                                const std::vector<Vec3>& loop, double margin) {
  const auto corner = [&](std::uint32_t v) {
    return v < positions.size() ? positions[v] : fill.new_positions[v - positions.size()];
  };
  std::vector<Vec3> places;
  for (const auto& [a, b, c] : fill.triangles) {
    const Vec3 middle = (corner(a) + corner(b) + corner(c)) / 3.0;
    if (distance_to(loop, middle) > margin) places.push_back(middle);
  }
  return places;
}

Box box_around(const std::vector<Vec3>& places, double margin) {
  Box box;
  for (const Vec3& p : places)
    box.add(p);
  return widened(box, margin);
}

}  // namespace

bool is_other_wall(const std::vector<Vec3>& positions, const CornerTable& table,
                   const BoundaryLoop& loop, const FaceTree& faces, const PointGrid& cloud,
                   double noise, double pixel_size, TriangulationMemo* memo) {
  const double h = pixel_size;
  std::vector<Vec3> around;
  for (const std::uint32_t v : vertices_of(loop, table))
    around.push_back(positions[v]);
  const HoleFill fill = fill_loop(positions, table, loop, FillShape::smooth, h, {}, memo);
  if (fill.triangles.empty()) return false;
  const std::vector<Vec3> places = places_inside(positions, fill, around, kFromLoop * h);
  if (places.size() < kFewestPlaces) return true;
  std::vector<Vec3> near;
  std::vector<std::size_t> first{0};  // of each place in near
  for (const Vec3& place : places) {
    cloud.for_each_near(place, kNear * h, [&](const Vec3& offset) {
      if (glm::dot(offset, offset) <= kNear * kNear * h * h) near.push_back(place + offset);
    });
    first.push_back(near.size());
  }
  const double off_mesh = std::max(kOffMesh * h, kOffMeshPerNoise * noise);
  const TriangleMesh part = faces.faces_in(box_around(places, kNear * h + off_mesh));
  const std::vector<std::uint8_t> is_on = covered_points(near, part, off_mesh);
  std::size_t shown = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto begin = is_on.begin() + static_cast<std::ptrdiff_t>(first[i]);
    const auto end = is_on.begin() + static_cast<std::ptrdiff_t>(first[i + 1]);
    shown += std::find(begin, end, 0) != end ? 1 : 0;
  }
  const auto off = static_cast<double>(std::count(is_on.begin(), is_on.end(), 0));
  return static_cast<double>(shown) >= kShown * static_cast<double>(places.size()) &&
         off >= kShown * static_cast<double>(near.size());
}

}  // namespace rangezip
