#include "core/finish/feature_place.h"

#include <catch2/catch.hpp>
#include <random>

#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

constexpr double kH = 0.1;
constexpr double kRough = 0.01 * kH * kH;  // mean square residual of smooth surfaces at the edges
const Box kRegion{Vec3(-2.0), Vec3(2.0)};

/// Points on the three sides of the corner of a box at the origin: x, y, z <= 0.
PointGrid corner_cloud(std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::vector<Vec3> points(6000);
  for (std::size_t i = 0; i < points.size(); ++i) {
    Vec3& p = points[i];
    p = {testing::uniform(engine, -1, 0), testing::uniform(engine, -1, 0),
         testing::uniform(engine, -1, 0)};
    p[static_cast<int>(i % 3)] = 0.0;
  }
  return {points, kRegion, kH};
}

/// The three planes seen from a place.
Surroundings corner_seen_from(const PointGrid& cloud, const Vec3& place) {
  Surroundings around{cloud, kH, 1.5 * kH, 0.0, place, {}};
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 normal(0.0);
    normal[axis] = 1.0;
    around.sides.push_back({{place[axis], normal, Mat3(0.0)}, 1.0});
  }
  return around;
}

TEST_CASE("a place by a corner goes to it, by an edge onto that, else onto the nearer side") {
  const std::uint64_t seed = GENERATE(1U, 2U, 3U);
  CAPTURE(seed);
  const PointGrid cloud = corner_cloud(seed);
  const auto found = [&](const Vec3& place) {
    const FeaturePlace feature = find_feature_place(corner_seen_from(cloud, place), kH, kRough);
    return std::pair(feature.count, place + feature.place);
  };
  const auto [corner_sides, corner] = found({-0.3 * kH, -0.2 * kH, -0.25 * kH});
  REQUIRE(corner_sides == 3);
  REQUIRE(glm::length(corner) < 1e-12);
  const auto [edge_sides, edge] = found({-0.2 * kH, -0.3 * kH, -0.5});
  REQUIRE(edge_sides == 2);
  REQUIRE(glm::distance(edge, Vec3(0, 0, -0.5)) < 1e-12);
  const auto [side_sides, side] = found({-0.1 * kH, -0.8 * kH, -0.5});
  REQUIRE(side_sides == 1);
  REQUIRE(glm::distance(side, Vec3(0, -0.8 * kH, -0.5)) < 1e-12);
}

TEST_CASE("an edge does not go on beyond the corner where it ends") {
  const PointGrid cloud = corner_cloud(4);
  const Surroundings around = corner_seen_from(cloud, {-0.1 * kH, -0.1 * kH, 1.0 * kH});
  const FeaturePlace feature = find_feature_place(around, kH, kRough);
  REQUIRE(feature.count != 2);
  if (feature.count > 0) REQUIRE(around.origin.z + feature.place.z < 0.05 * kH);
}

TEST_CASE("the only side takes a place in if no smooth surface is around that and it is not far") {
  const PointGrid cloud = corner_cloud(6);
  const auto found = [&](double way, double residual) {
    Surroundings around{cloud, kH, 1.5 * kH, 0.0, {-0.5, -0.5, way * kH}, {}};
    around.sides.push_back({{way * kH, Vec3(0.0, 0.0, 1.0), Mat3(0.0)}, 1.0});
    return find_feature_place(around, kH, residual * residual * kH * kH);
  };
  const FeaturePlace near = found(0.7, 1.0);
  REQUIRE(near.count == 1);
  REQUIRE(glm::distance(near.place, Vec3(0.0, 0.0, -0.7 * kH)) < 1e-12);
  REQUIRE(found(0.7, 0.19).count == 0);
  REQUIRE(found(2.6, 1.0).count == 0);
}

TEST_CASE("no place is found where points are not on the sides, or the surface is smooth as well") {
  const PointGrid cloud = corner_cloud(5);
  Surroundings around = corner_seen_from(cloud, {-0.2 * kH, -0.3 * kH, -0.5});
  REQUIRE(find_feature_place(around, kH, kRough).count == 2);
  REQUIRE(find_feature_place(around, kH, 0.0).count == 0);
  for (FeatureSide& side : around.sides)
    side.height.constant -= 0.3 * kH;
  REQUIRE(find_feature_place(around, kH, kRough).count == 0);
}

TEST_CASE("the residual of sides is the mean square distance of the points") {
  const PointGrid cloud = corner_cloud(6);
  Surroundings around = corner_seen_from(cloud, {0, 0, -0.5});
  REQUIRE(*residual2_of_sides(around, Vec3(0.0), {0, 1}) < 1e-12);
  around.sides[0].height.constant -= 0.02 * kH;
  around.sides[1].height.constant -= 0.02 * kH;
  REQUIRE(*residual2_of_sides(around, Vec3(0.0), {0, 1}) == Approx(4e-4 * kH * kH).epsilon(0.2));
  REQUIRE_FALSE(residual2_of_sides(around, Vec3(0.0), {0, 2}));  // no point on the third
}

}  // namespace
}  // namespace rangezip
