#include "core/finish/refit_sides.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

using testing::uniform;

constexpr double kH = 0.1;
const Box kRegion{Vec3(-2.0), Vec3(2.0)};

/// Points of the planes z = 0 where x < 0 and x = 0 where z < 0: an edge along the y-axis.
PointGrid edge_cloud(double noise) {
  std::mt19937_64 engine(3);
  std::vector<Vec3> points(6000);
  for (std::size_t i = 0; i < points.size(); ++i) {
    Vec3& p = points[i];
    p = {uniform(engine, -1, 0), uniform(engine, -1, 1), uniform(engine, -1, 0)};
    p[i % 2 == 0 ? 0 : 2] = noise * uniform(engine, -1, 1);
  }
  return {points, kRegion, kH};
}

/// The two planes as they look from a place, raised and tilted.
Surroundings misplaced_sides(const PointGrid& cloud, const Vec3& place, double raise, double tilt) {
  Surroundings around{cloud, kH, 1.5 * kH, 0.0, place, {}};
  around.sides.push_back(
      {{place.z + raise, glm::normalize(Vec3(tilt, -tilt, 1.0)), Mat3(0.0)}, 1.0});
  around.sides.push_back(
      {{place.x - raise, glm::normalize(Vec3(1.0, tilt, tilt)), Mat3(0.0)}, 1.0});
  return around;
}

double height_error(const FeatureSide& side, const Vec3& place, int axis) {
  double most = 0.0;
  for (const Vec3& d : {Vec3(0.0), Vec3(kH, 0, 0), Vec3(0, kH, 0), Vec3(0, 0, kH)}) {
    const double length = glm::length(side.height.slope);
    most = std::max(most, std::abs(side.height.at(d) / length - (place + d)[axis]));
  }
  return most;
}

TEST_CASE("sides that are a little off come to lie on the points") {
  const PointGrid cloud = edge_cloud(0.0);
  const double raise = GENERATE(-0.1, 0.1) * kH, tilt = GENERATE(-0.1, 0.0, 0.1);
  CAPTURE(raise, tilt);
  const Vec3 place(-0.2 * kH, 0.0, -0.3 * kH);
  const Surroundings around = misplaced_sides(cloud, place, raise, tilt);
  const std::vector<FeatureSide> sides = refit_sides(around);
  REQUIRE(sides.size() == 2);
  for (int i = 0; i < 2; ++i) {
    const int axis = i == 0 ? 2 : 0;
    CAPTURE(axis);
    const auto k = static_cast<std::size_t>(i);
    REQUIRE(height_error(around.sides[k], place, axis) > 0.05 * kH);
    REQUIRE(height_error(sides[k], place, axis) < 0.01 * kH);
  }
}

TEST_CASE("noise moves a fitted side by less than itself") {
  const double noise = 0.1 * kH;
  const PointGrid cloud = edge_cloud(noise);
  const Vec3 place(0.0, 0.0, -0.3 * kH);
  const std::vector<FeatureSide> sides = refit_sides(misplaced_sides(cloud, place, 0.0, 0.0));
  REQUIRE(height_error(sides[0], place, 2) < noise);
  REQUIRE(height_error(sides[1], place, 0) < noise);
}

TEST_CASE("a side without points stays as it is") {
  const PointGrid cloud = edge_cloud(0.0);
  const Surroundings around = misplaced_sides(cloud, Vec3(1.5, 0.0, 1.5), 0.1 * kH, 0.1);
  const std::vector<FeatureSide> sides = refit_sides(around);
  for (std::size_t i = 0; i < 2; ++i) {
    REQUIRE(sides[i].height.constant == around.sides[i].height.constant);
    REQUIRE(sides[i].height.slope == around.sides[i].height.slope);
  }
}

}  // namespace
}  // namespace rangezip
