#include <catch2/catch.hpp>
#include <limits>

#include "core/plan/spacing.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

Scene scene_of(const TriangleSoup& soup, const Mat4& placement = Mat4{1.0}) {
  Scene scene;
  scene.add(std::make_shared<TriangleSoup>(soup), placement);
  return scene;
}

double distance_to(const TriangleSoup& soup, const Vec3& point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Triangle& t : soup.triangles) {
    const Vec3 closest = closest_point_on_triangle(
        point, Vec3(soup.positions[t[0]]), Vec3(soup.positions[t[1]]), Vec3(soup.positions[t[2]]));
    nearest = std::min(nearest, glm::length(point - closest));
  }
  return nearest;
}

}  // namespace

TEST_CASE("area_samples give the wanted number of points on the surface") {
  for (const TriangleSoup& soup : {shapes::cube(), shapes::washer(), shapes::sphere(1.0, 12)}) {
    for (const std::size_t count : {1U, 10U, 2000U}) {
      const std::vector<Vec3> samples = area_samples(scene_of(soup), count);
      REQUIRE(samples.size() == count);
      for (const Vec3& sample : samples)
        REQUIRE(distance_to(soup, sample) < 1e-12);
    }
  }
}

TEST_CASE("area_samples give each triangle its share, to within one sample") {
  const TriangleSoup plate = shapes::plate(0.1);
  const std::size_t count = 10'000;
  std::size_t on_top = 0;
  for (const Vec3& p : area_samples(scene_of(plate), count))
    on_top += p.z > 0.05F - 1e-9 ? 1 : 0;
  // 4 of 8.8 are the top, two triangles laid end to end (the sides' upper edges have no area).
  CHECK(std::abs(static_cast<double>(on_top) - 10'000 * 4.0 / 8.8) <= 2.0);
}

TEST_CASE("area_samples leave no large gap in a large triangle") {
  const std::size_t count = 4096;
  const TriangleSoup cube = shapes::cube();
  const std::vector<Vec3> samples = area_samples(scene_of(cube), count);
  const double spacing = std::sqrt(24.0 / static_cast<double>(count));
  for (const PointCloud& cloud : {shapes::sampled(cube, 2000, 11)}) {
    for (const Vec3f& any : cloud.positions) {
      double nearest = 10.0;
      for (const Vec3& sample : samples) {
        nearest = std::min(nearest, glm::length(sample - Vec3(any)));
      }
      REQUIRE(nearest < 3.0 * spacing);  // random samples would leave 5 somewhere
    }
  }
}

TEST_CASE("area_samples lie where the scene places its polygons") {
  const Mat4 placement = shapes::translation({636'763.0, 851'298.0, 415.0}) * shapes::tilt();
  const std::vector<Vec3> moved = area_samples(scene_of(shapes::cube(), placement), 500);
  const std::vector<Vec3> still = area_samples(scene_of(shapes::cube()), 500);
  REQUIRE(moved.size() == still.size());
  std::size_t near = 0;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    near += glm::length(moved[i] - Vec3(placement * Vec4(still[i], 1.0))) < 1e-4 ? 1 : 0;
  }
  CHECK(near >= 490);  // rounding of areas may move a sample over the edge between triangles
  CHECK(triangle_area(scene_of(shapes::cube(), placement)) == Approx(24.0).epsilon(1e-6));
}

TEST_CASE("area_samples skip what has no area") {
  TriangleSoup soup = shapes::cube();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto first = static_cast<std::uint32_t>(soup.positions.size());
  soup.positions.insert(soup.positions.end(), {{0, 0, 0}, {9, 9, 9}, {nan, 0, 0}});
  soup.triangles.insert(soup.triangles.begin(), {first, first, first + 1});
  soup.triangles.insert(soup.triangles.begin() + 5, {first, first + 1, first + 2});
  const std::vector<Vec3> samples = area_samples(scene_of(soup), 300);
  REQUIRE(samples.size() == 300);
  for (const Vec3& p : samples) {
    CHECK(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) == Approx(1.0).margin(1e-12));
  }
  CHECK(triangle_area(scene_of(soup)) == Approx(24.0));
  CHECK(area_samples(Scene{}, 100).empty());
  CHECK(area_samples(scene_of(soup), 0).empty());
}

}  // namespace rangezip
