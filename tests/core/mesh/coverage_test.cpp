#include "core/mesh/coverage.h"

#include <catch2/catch.hpp>

#include "core/base/error.h"
#include "tests/support/shapes.h"

using namespace rangezip;

namespace {

/// The unit square in the plane z = 0.
TriangleMesh unit_square() {
  return {.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
          .triangles = {{0, 1, 2}, {0, 2, 3}}};
}

}  // namespace

TEST_CASE("coverage_of counts a point exactly at the distance and none beyond it", "[mesh]") {
  const TriangleMesh square = unit_square();
  CHECK(coverage_of(std::vector<Vec3>{{0.5, 0.5, 0.25}}, square, 0.25) == 1.0);
  CHECK(coverage_of(std::vector<Vec3>{{0.5, 0.5, 0.2500001}}, square, 0.25) == 0.0);
  CHECK(coverage_of(std::vector<Vec3>{{1.25, 0.5, 0}, {1.26, 0.5, 0}}, square, 0.25) == 0.5);
}

TEST_CASE("coverage_of agrees with the distance to every face", "[mesh]") {
  const TriangleMesh mesh = shapes::to_mesh(shapes::torus(1.0, 0.4, 32));
  const auto seed = GENERATE(range(1, 4));
  CAPTURE(seed);
  shapes::Random random(static_cast<std::uint64_t>(seed));
  std::vector<Vec3> points(2'000);
  for (Vec3& p : points) {
    p = {random.between(-1.6, 1.6), random.between(-1.6, 1.6), random.between(-0.6, 0.6)};
  }
  const double distance = random.between(0.02, 0.3);
  std::size_t near = 0;
  for (const Vec3& p : points) {
    bool found = false;
    for (const Triangle& t : mesh.triangles) {
      const Vec3 q = closest_point_on_triangle(p, mesh.positions[t[0]], mesh.positions[t[1]],
                                               mesh.positions[t[2]]);
      found = found || glm::dot(p - q, p - q) <= distance * distance;
    }
    near += found ? 1U : 0U;
  }
  CHECK(coverage_of(points, mesh, distance) ==
        static_cast<double>(near) / static_cast<double>(points.size()));
}

TEST_CASE("coverage_of is whole for no points and nothing for no mesh", "[mesh]") {
  CHECK(coverage_of({}, unit_square(), 1.0) == 1.0);
  CHECK(coverage_of(std::vector<Vec3>{{0, 0, 0}}, TriangleMesh{}, 1.0) == 0.0);
}

TEST_CASE("coverage_of refuses a distance that is no length", "[mesh]") {
  for (const double distance : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                                std::numeric_limits<double>::infinity()}) {
    CAPTURE(distance);
    CHECK_THROWS_AS(coverage_of({}, unit_square(), distance), InvalidArgument);
  }
}
