#include "core/finish/places_near.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>
#include <vector>

#include "tests/core/finish/shapes.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

using testing::uniform;

TEST_CASE("points near places are those that a look at every place finds, in their order") {
  const std::uint64_t seed = GENERATE(1U, 2U);
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  const auto random_points = [&](int count) {
    std::vector<Vec3> points;
    for (int i = 0; i < count; ++i) {
      const double x = uniform(engine, 0.0, 10.0), y = uniform(engine, 0.0, 10.0);
      points.emplace_back(x, y, uniform(engine, 0.0, 10.0));
    }
    return points;
  };
  const std::vector<Vec3> points = random_points(2000), places = random_points(40);
  constexpr double kRadius = 0.8;
  std::vector<Vec3> expected;
  std::copy_if(points.begin(), points.end(), std::back_inserter(expected), [&](const Vec3& p) {
    return std::any_of(places.begin(), places.end(),
                       [&](const Vec3& place) { return glm::length(place - p) <= kRadius; });
  });
  REQUIRE(expected.size() > 50);
  const PointGrid grid(places, Box{Vec3(0.0), Vec3(10.0)}, 0.5 * kRadius);
  CHECK(points_near(points, grid, kRadius) == expected);
  // Those of a cloud are the same ones, but for being floats, in another order.
  const PointGrid cloud(points, Box{Vec3(0.0), Vec3(10.0)}, 1.0);
  CHECK(points_near(cloud, grid, kRadius).size() == expected.size());
}

TEST_CASE("the part near a place holds the faces that begin there, and no other") {
  const TriangleMesh mesh = shapes::square_sheet(20);
  const std::vector<Vec3> places{{2.0, 3.0, 0.0}};
  constexpr double kRadius = 2.5;
  const PointGrid grid(places, Box{Vec3(-20.0), Vec3(20.0)}, kRadius);
  const FacePart part = part_near(mesh, grid, kRadius);
  std::size_t expected = 0;
  for (const Triangle& t : mesh.triangles)
    expected += glm::length(mesh.positions[t[0]] - places[0]) <= kRadius ? 1 : 0;
  CHECK(expected > 20);
  CHECK(part.faces.size() == expected);
}

}  // namespace
}  // namespace rangezip
