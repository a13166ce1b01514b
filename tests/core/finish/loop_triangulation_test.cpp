#include "core/finish/loop_triangulation.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "core/finish/boundary_loops.h"
#include "core/finish/point_grid.h"
#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

using testing::uniform;

constexpr double kH = 1.0;
constexpr double kPi = 3.14159265358979323846;
constexpr int kAround = 20;
constexpr double kRadius = 1.5;

/// A crack around the wall of a tube along z, which a bridge of one edge interrupts: a loop along
/// one side of it and back along the other. Beyond, the surface is that of a plate on either side.
LoopShape crack_around_tube(double width, int around = kAround, double radius = kRadius) {
  LoopShape shape;
  const auto add = [&](int i, double z, const Vec3& normal) {
    const double angle = 2.0 * kPi * i / around;
    shape.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    shape.edge_normals.push_back(normal);
  };
  for (int i = 0; i < around; ++i)
    add(i, 0.0, Vec3(0.0, 0.0, 1.0));
  for (int i = around - 1; i >= 0; --i)
    add(i, width, Vec3(0.0, 0.0, -1.0));
  shape.long_side = 1.5 * kH;
  return shape;
}

double least_radius(const LoopShape& shape, const std::vector<Triangle>& triangles) {
  double least = 100.0;
  for (const Triangle& t : triangles) {
    const Vec3 middle = (shape.points[t[0]] + shape.points[t[1]] + shape.points[t[2]]) / 3.0;
    least = std::min(least, std::hypot(middle.x, middle.y));
  }
  return least;
}

TEST_CASE("a crack around a tube is closed along the wall where the tube is known to hold air",
          "[finish]") {
  LoopShape shape = crack_around_tube(3.0);
  // Lids over both ends are flat, and so the least sharp.
  const std::vector<Triangle> lids = triangulate_loop(shape);
  CHECK(least_radius(shape, lids) < 0.5 * kRadius);
  shape.is_in_air = [](const Vec3& place) {
    return std::hypot(place.x, place.y) < kRadius - 0.75 * kH;
  };
  const std::vector<Triangle> strip = triangulate_loop(shape);
  CHECK(strip.size() == shape.points.size() - 2);
  CHECK(least_radius(shape, strip) > 0.9 * kRadius);
}

TEST_CASE("by length of its sides a crack is closed along it, whatever the faces beside it",
          "[finish]") {
  LoopShape shape = crack_around_tube(0.5 * kH);
  shape.by_length = true;
  const std::vector<Triangle> strip = triangulate_loop(shape);
  CHECK(strip.size() == shape.points.size() - 2);
  CHECK(least_radius(shape, strip) > 0.9 * kRadius);
}

TEST_CASE("a long crack around a tube is divided across, not along the bridge that interrupts it",
          "[finish]") {
  constexpr double kWide = 8.0;
  LoopShape shape = crack_around_tube(3.0, 70, kWide);
  REQUIRE(glm::distance(shape.points[0], shape.points[69]) < 3.0);  // the shortest chord
  shape.is_in_air = [](const Vec3& place) { return std::hypot(place.x, place.y) < kWide - kH; };
  const std::vector<Triangle> strip = triangulate_loop(shape);
  CHECK(strip.size() == shape.points.size() - 2);
  CHECK(least_radius(shape, strip) > 0.9 * kWide);
}

TEST_CASE("what is in the air either way is closed as if nothing were known", "[finish]") {
  LoopShape shape = crack_around_tube(3.0);
  const std::vector<Triangle> unknown = triangulate_loop(shape);
  shape.is_in_air = [](const Vec3&) { return true; };
  shape.long_side = 0.0;
  CHECK(triangulate_loop(shape) == unknown);
}

TEST_CASE("air is where no point is near, as far as points along the border lie apart",
          "[finish]") {
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  std::vector<Vec3> points;
  for (int i = 0; i < 2000; ++i)
    points.push_back({uniform(engine, -15, 15), uniform(engine, -15, 15), 0.0});
  const Box region{Vec3(-20.0), Vec3(20.0)};
  const PointGrid cloud(points, region, 0.7 * kH);
  const std::vector<Vec3> border{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const AirTest is_in_air = air_test({&cloud, kH}, border);
  REQUIRE(is_in_air);
  CHECK(is_in_air(Vec3(0.0, 0.0, 1.0)));
  int in_air = 0;
  for (int i = 0; i < 1000; ++i)
    in_air += is_in_air({uniform(engine, -10, 10), uniform(engine, -10, 10), 0.0}) ? 1 : 0;
  CHECK(in_air < 60);  // one in twenty; the spacing is 0.67
  CHECK_FALSE(air_test({}, border));
  const PointGrid nothing({}, region, kH);
  CHECK_FALSE(air_test({&nothing, kH}, border));
}

}  // namespace
}  // namespace rangezip
