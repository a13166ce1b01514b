#include "core/reconstruct/dense_places.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/sphere_set.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

constexpr double kH = 0.05;
constexpr double kStep = kH / 2.2;  // of the points where they are sparse

/// Points of the unit sphere, on a spiral; `times` as dense along each direction where z > 0.5.
std::vector<Vec3> sphere_points(double times) {
  std::vector<Vec3> points;
  double z = -1.0, angle = 0.0;
  while (z < 1.0) {
    const double step = z > 0.5 ? kStep / times : kStep;
    const double radius = std::sqrt(1.0 - z * z);
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    z += step * step / (2.0 * std::numbers::pi);
    angle += 2.399963229728653;  // the golden angle spreads them evenly
  }
  return points;
}

TriangleMesh mesh_of(const TriangleSoup& soup) {
  TriangleMesh mesh;
  mesh.positions.assign(soup.positions.begin(), soup.positions.end());
  mesh.triangles = soup.triangles;
  return mesh;
}

}  // namespace

TEST_CASE("dense places hold all of the dense part and hardly more, with its points",
          "[reconstruct]") {
  const std::vector<Vec3> points = sphere_points(3.0);
  const DensePlaces found = find_dense_places(points, mesh_of(shapes::sphere()), kH, 0.0);
  REQUIRE_FALSE(found.places.empty());
  CHECK(found.pixel_size == Approx(kH / 3.0).epsilon(0.1));
  const SphereSet inside(found.places);
  std::size_t held = 0;
  for (const Vec3& p : points) {
    const bool is_inside = inside.contains(p);
    held += is_inside ? 1 : 0;
    if (p.z > 0.5 + 5.0 * kH) CHECK(is_inside);
    if (p.z < 0.5 - 8.0 * kH) CHECK_FALSE(is_inside);
  }
  CHECK(found.points.size() == held);
}

TEST_CASE("an even cloud has no dense places", "[reconstruct]") {
  CHECK(find_dense_places(sphere_points(1.0), mesh_of(shapes::sphere()), kH, 0.0).places.empty());
}

}  // namespace rangezip
