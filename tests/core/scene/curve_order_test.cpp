#include "core/scene/curve_order.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>
#include <tuple>

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

bool is_before(const Vec3f& a, const Vec3f& b) {
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

double path_length(std::span<const Vec3f> points) {
  double sum = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i)
    sum += glm::length(Vec3(points[i]) - Vec3(points[i - 1]));
  return sum;
}

}  // namespace

TEST_CASE("Ordering along a curve keeps every point and only moves it") {
  std::vector<Vec3f> points = random_points(20'000, 5);
  points.insert(points.end(), points.begin(), points.begin() + 100);  // doubles stay doubles
  std::vector<Vec3f> ordered = ordered_along_curve(points);
  std::sort(points.begin(), points.end(), is_before);
  std::sort(ordered.begin(), ordered.end(), is_before);
  CHECK(points == ordered);
}

TEST_CASE("The corners of a cube come in the order of the curve's code") {
  const std::vector<Vec3f> corners{{1, 1, 1}, {0, 1, 1}, {1, 0, 1}, {0, 0, 1},
                                   {1, 1, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 0}};
  const std::vector<Vec3f> reversed(corners.rbegin(), corners.rend());
  CHECK(ordered_along_curve(corners) == reversed);
}

TEST_CASE("Points of one cell keep their order, and so does what is ordered already") {
  const std::vector<Vec3f> equal{{2, 2, 2}, {2, 2, 2}, {2, 2, 2}};
  CHECK(ordered_along_curve(equal) == equal);
  const std::vector<Vec3f> once = ordered_along_curve(random_points(5000, 6));
  CHECK(ordered_along_curve(once) == once);
}

TEST_CASE("Random points do not follow each other; along the curve they do, on a shorter path") {
  const std::vector<Vec3f> points = random_points(400'000, 7);
  const std::vector<Vec3f> ordered = ordered_along_curve(points);
  CHECK_FALSE(follow_each_other(points));
  CHECK(follow_each_other(ordered));
  // Neighbours on the curve are about 400000^(-1/3) = 1/74 of the side apart, at random 0.66.
  CHECK(path_length(ordered) < 0.05 * path_length(points));
}

TEST_CASE("Clouds too small to have an order, and flat ones, are ordered too") {
  CHECK(ordered_along_curve({}).empty());
  CHECK(follow_each_other({}));
  const std::vector<Vec3f> one{{1, 2, 3}};
  CHECK(ordered_along_curve(one) == one);
  CHECK(follow_each_other(one));
  const std::vector<Vec3f> line{{3, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  const std::vector<Vec3f> sorted{{1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  CHECK(ordered_along_curve(line) == sorted);
}

}  // namespace rangezip
