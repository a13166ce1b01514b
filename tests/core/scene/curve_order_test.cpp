#include "core/scene/curve_order.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <memory>
#include <random>

#include "core/base/error.h"

namespace rangezip {
namespace {

std::vector<Vec3f> random_points(std::size_t count, std::uint32_t seed) {
  std::mt19937 engine(seed);
  const auto uniform = [&] { return static_cast<float>(engine() >> 8U) * 0x1p-24F; };
  std::vector<Vec3f> points(count);
  for (Vec3f& p : points) {
    p.x = uniform();
    p.y = uniform();
    p.z = uniform();
  }
  return points;
}

double path_length(std::span<const Vec3f> points) {
  double sum = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i)
    sum += glm::length(Vec3(points[i]) - Vec3(points[i - 1]));
  return sum;
}

}  // namespace

TEST_CASE("Ordering along a curve keeps every point, with its number in the order given") {
  PointCloud cloud{random_points(20'000, 5)};
  cloud.positions.insert(cloud.positions.end(), cloud.positions.begin(),
                         cloud.positions.begin() + 100);  // doubles stay doubles
  const PointCloud ordered = ordered_along_curve(cloud);
  REQUIRE(ordered.numbers.size() == cloud.positions.size());
  std::vector<bool> is_there(cloud.positions.size(), false);
  for (std::size_t i = 0; i < ordered.positions.size(); ++i) {
    CHECK(ordered.positions[i] == cloud.positions[ordered.numbers[i]]);
    is_there[ordered.numbers[i]] = true;
  }
  CHECK(std::find(is_there.begin(), is_there.end(), false) == is_there.end());
}

TEST_CASE("The corners of a cube come in the order of the curve's code") {
  const PointCloud corners{
      {{1, 1, 1}, {0, 1, 1}, {1, 0, 1}, {0, 0, 1}, {1, 1, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 0}}};
  const PointCloud ordered = ordered_along_curve(corners);
  CHECK(std::equal(ordered.positions.begin(), ordered.positions.end(), corners.positions.rbegin()));
  CHECK(ordered.numbers == std::vector<std::uint32_t>{7, 6, 5, 4, 3, 2, 1, 0});
}

TEST_CASE("Points of one cell keep their order, and numbers are those of the first owner") {
  const PointCloud equal{{{2, 2, 2}, {2, 2, 2}, {2, 2, 2}}, {1, 2, 0}};
  CHECK(ordered_along_curve(equal).numbers == equal.numbers);
  const PointCloud once = ordered_along_curve({random_points(5000, 6)});
  const PointCloud twice = ordered_along_curve(once);
  CHECK(twice.positions == once.positions);
  CHECK(twice.numbers == once.numbers);
}

TEST_CASE("Random points do not follow each other; along the curve they do, on a shorter path") {
  const PointCloud cloud{random_points(400'000, 7)};
  const PointCloud ordered = ordered_along_curve(cloud);
  CHECK_FALSE(follow_each_other(cloud.positions));
  CHECK(follow_each_other(ordered.positions));
  // Neighbours on the curve are about 400000^(-1/3) = 1/74 of the side apart, at random 0.66.
  CHECK(path_length(ordered.positions) < 0.05 * path_length(cloud.positions));
}

TEST_CASE("Clouds too small to have an order, and flat ones, are ordered too") {
  CHECK(ordered_along_curve({}).positions.empty());
  CHECK(follow_each_other({}));
  const PointCloud one{{{1, 2, 3}}};
  CHECK(ordered_along_curve(one).positions == one.positions);
  CHECK(follow_each_other(one.positions));
  const PointCloud line{{{3, 0, 0}, {1, 0, 0}, {2, 0, 0}}};
  CHECK(ordered_along_curve(line).numbers == std::vector<std::uint32_t>{1, 2, 0});
}

TEST_CASE("A scene tells the number of a point that was put in another order") {
  const PointCloud cloud{random_points(1000, 8)};
  const auto ordered = std::make_shared<const PointCloud>(ordered_along_curve(cloud));
  Scene scene;
  scene.add(std::make_shared<const PointCloud>(PointCloud{{{0, 0, 0}, {1, 0, 0}}}));
  scene.add(ordered);
  CHECK(scene.number_of(1) == 1);
  for (PrimitiveId i = 0; i < 1000; ++i) {
    const PrimitiveId number = scene.number_of(2 + i);
    REQUIRE(number >= 2);
    CHECK(cloud.positions[number - 2] == ordered->positions[i]);
  }
  CHECK(scene.number_of(kNoPrimitive) == kNoPrimitive);
  CHECK_THROWS_AS(scene.number_of(1002), InvalidArgument);
}

TEST_CASE("Ordering along a curve stops when the caller asks for the end") {
  std::stop_source source;
  source.request_stop();
  CHECK_THROWS_AS(
      ordered_along_curve(PointCloud{random_points(10, 1)}, {.stop = source.get_token()}),
      Cancelled);
}

TEST_CASE("A scene refuses numbers that are too many, too few or too large") {
  Scene scene;
  const std::vector<Vec3f> two{{0, 0, 0}, {1, 0, 0}};
  CHECK_THROWS_AS(scene.add(std::make_shared<const PointCloud>(PointCloud{two, {0}})),
                  InvalidArgument);
  CHECK_THROWS_AS(scene.add(std::make_shared<const PointCloud>(PointCloud{two, {0, 2}})),
                  InvalidArgument);
}

}  // namespace rangezip
