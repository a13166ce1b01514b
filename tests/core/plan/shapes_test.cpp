#include "tests/support/shapes.h"

#include <catch2/catch.hpp>

#include "core/mesh/mesh_report.h"

namespace rangezip {
namespace {

/// Volume enclosed by a closed soup; positive when its faces look outward.
double volume_of(const TriangleSoup& soup) {
  double volume = 0.0;
  for (const Triangle& t : soup.triangles) {
    volume += glm::dot(Vec3(soup.positions[t[0]]),
                       glm::cross(Vec3(soup.positions[t[1]]), Vec3(soup.positions[t[2]]))) /
              6.0;
  }
  return volume;
}

struct Expected {
  const char* name;
  TriangleSoup soup;
  std::ptrdiff_t euler;
  std::size_t components;
  std::size_t loops;
  double volume;  ///< of the smooth shape; the polygons lie inside of it
};

}  // namespace

TEST_CASE("test shapes are welded, oriented outward and of the right kind") {
  constexpr double kPi = std::numbers::pi;
  const std::vector<Expected> shapes{
      {"sphere", shapes::sphere(), 2, 1, 0, 4.0 / 3.0 * kPi},
      {"torus", shapes::torus(), 0, 1, 0, 2.0 * kPi * kPi * 0.16},
      {"cube", shapes::cube(), 2, 1, 0, 8.0},
      {"plate", shapes::plate(0.1), 2, 1, 0, 0.4},
      {"bowl", shapes::bowl(), 1, 1, 1, 2.0 / 3.0 * kPi},
      {"shell", shapes::shell(0.1), 2, 1, 0, 2.0 / 3.0 * kPi * (1.0 - 0.729)},
      {"washer", shapes::washer(), 0, 1, 0, kPi * (1.0 - 0.16) * 0.5},
      {"pocket", shapes::pocket(0.6), 2, 1, 0, kPi * (2.0 - 0.09 * 0.6)},
      {"trefoil", shapes::trefoil(), 0, 1, 0, -1.0},
      {"two spheres", shapes::two_spheres(0.1), 4, 2, 0, 8.0 / 3.0 * kPi},
      {"tilted cube", shapes::moved(shapes::cube(), shapes::tilt()), 2, 1, 0, 8.0},
  };
  for (const Expected& shape : shapes) {
    CAPTURE(shape.name);
    const TriangleMesh mesh = shapes::to_mesh(shape.soup);
    REQUIRE_NOTHROW(check_mesh(mesh));
    const MeshReport report = report_mesh(mesh);
    CHECK(report.euler == shape.euler);
    CHECK(report.components == shape.components);
    CHECK(report.boundary_loops == shape.loops);
    CHECK(report.vertices == mesh.positions.size());
    CHECK(volume_of(shape.soup) > 0.0);
    // 64 segments lose 1 - sin(x)/x = 0.2 % of a circle's area, and as much along the profile.
    if (shape.volume > 0.0) CHECK(volume_of(shape.soup) == Approx(shape.volume).epsilon(0.01));
  }
}

TEST_CASE("sampled points lie on the shape and repeat for the same seed") {
  const PointCloud cloud = shapes::sampled(shapes::sphere(2.0, 200), 1000, 7);
  REQUIRE(cloud.positions.size() == 1000);
  for (const Vec3f& p : cloud.positions) {
    // The sagitta of a chord of 2 pi / 400: 2 (1 - cos(pi / 400)) < 1e-4, twice (two directions).
    CHECK(glm::length(Vec3(p)) == Approx(2.0).margin(2e-4));
  }
  CHECK(shapes::sampled(shapes::sphere(2.0, 200), 1000, 7).positions == cloud.positions);
  CHECK(shapes::sampled(shapes::sphere(2.0, 200), 1000, 8).positions != cloud.positions);
}

}  // namespace rangezip
