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

using Flags = std::vector<std::uint8_t>;

}  // namespace

TEST_CASE("covered_points takes a point exactly at the distance and none beyond it", "[mesh]") {
  const TriangleMesh square = unit_square();
  CHECK(covered_points(std::vector<Vec3>{{0.5, 0.5, 0.25}}, square, 0.25) == Flags{1});
  CHECK(covered_points(std::vector<Vec3>{{0.5, 0.5, 0.2500001}}, square, 0.25) == Flags{0});
  CHECK(covered_points(std::vector<Vec3>{{1.25, 0.5, 0}, {1.26, 0.5, 0}}, square, 0.25) ==
        Flags{1, 0});
}

TEST_CASE("covered_points agrees with the distance to every face", "[mesh]") {
  const TriangleMesh mesh = shapes::to_mesh(shapes::torus(1.0, 0.4, 32));
  const auto seed = GENERATE(range(1, 4));
  CAPTURE(seed);
  shapes::Random random(static_cast<std::uint64_t>(seed));
  std::vector<Vec3> points(2'000);
  for (Vec3& p : points) {
    p = {random.between(-1.6, 1.6), random.between(-1.6, 1.6), random.between(-0.6, 0.6)};
  }
  const double distance = random.between(0.02, 0.3);
  Flags near;
  for (const Vec3& p : points) {
    bool found = false;
    for (const Triangle& t : mesh.triangles) {
      const Vec3 q = closest_point_on_triangle(p, mesh.positions[t[0]], mesh.positions[t[1]],
                                               mesh.positions[t[2]]);
      found = found || glm::dot(p - q, p - q) <= distance * distance;
    }
    near.push_back(found ? 1 : 0);
  }
  CHECK(covered_points(points, mesh, distance) == near);
}

TEST_CASE("covered_points is empty for no points and nothing for no mesh", "[mesh]") {
  CHECK(covered_points({}, unit_square(), 1.0).empty());
  CHECK(covered_points(std::vector<Vec3>{{0, 0, 0}}, TriangleMesh{}, 1.0) == Flags{0});
}

TEST_CASE("covered_points refuses a distance that is no length", "[mesh]") {
  for (const double distance : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                                std::numeric_limits<double>::infinity()}) {
    CAPTURE(distance);
    CHECK_THROWS_AS(covered_points({}, unit_square(), distance), InvalidArgument);
  }
}
