#include "core/io/split_polygon.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <vector>

#include "tests/support/shapes.h"

namespace rangezip {
namespace {

/// The pieces of a polygon whose corners are numbered in order.
std::vector<Triangle> split(const std::vector<Vec3>& positions) {
  std::vector<std::uint32_t> polygon(positions.size());
  std::iota(polygon.begin(), polygon.end(), 0U);
  std::vector<Triangle> triangles;
  split_polygon(polygon, positions, triangles);
  return triangles;
}

Vec3 area_of(const std::vector<Vec3>& positions, const Triangle& t) {
  return area_vector(positions[t[0]], positions[t[1]], positions[t[2]]);
}

/// Of the outline: the sum of the area vectors of any split that covers it once.
Vec3 outline_area(const std::vector<Vec3>& positions) {
  Vec3 sum{0.0};
  for (std::size_t i = 0; i < positions.size(); ++i) {
    sum += glm::cross(positions[i], positions[(i + 1) % positions.size()]);
  }
  return sum;
}

/// Turns about an axis that is parallel to none of the coordinate axes.
Vec3 tilted(const Vec3& p) {
  const Mat3 rotation = Mat3{2, -2, 1, 1, 2, 2, -2, -1, 2} / 3.0;
  return rotation * p;
}

}  // namespace

TEST_CASE("A star-shaped polygon is cut into triangles inside it that cover it once") {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    CAPTURE(seed);
    shapes::Random random(seed);
    std::vector<Vec3> positions;
    const int corners = 4 + static_cast<int>(random.bits() % 30);
    for (int i = 0; i < corners; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / corners;
      const double radius = random.between(0.1, 1.0);
      positions.push_back(tilted({radius * std::cos(angle), radius * std::sin(angle), 0.0}));
    }
    if (seed % 2 == 1) std::reverse(positions.begin(), positions.end());
    const Vec3 normal = outline_area(positions);
    const std::vector<Triangle> triangles = split(positions);
    CHECK(triangles.size() == positions.size() - 2);
    double size_sum = 0.0;
    for (const Triangle& t : triangles) {
      const Vec3 area = area_of(positions, t);
      CHECK(glm::dot(area, normal) > 0.0);  // each turns with the outline, so none lies outside
      size_sum += glm::length(area);
    }
    // At most 34 terms below 2 pi; each is off by a few units in the last place of 1.
    CHECK(std::abs(size_sum - glm::length(normal)) < 1e-13);
  }
}

TEST_CASE("A convex polygon becomes a fan in its own orientation") {
  const std::vector<Vec3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  CHECK(split(square) == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
}

TEST_CASE("An arrow is cut along its only inner diagonal") {
  const std::vector<Vec3> arrow{{2, 0, 0}, {0, 1, 0}, {0.5, 0, 0}, {0, -1, 0}};
  const std::vector<Triangle> triangles = split(arrow);
  REQUIRE(triangles.size() == 2);
  for (const Triangle& t : triangles)
    CHECK(area_of(arrow, t).z > 0.0);
}

TEST_CASE("Polygons with repeated corners give no triangle without three places") {
  CHECK(split({{0, 0, 0}, {1, 0, 0}}).empty());
  CHECK(split({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}}).empty());
  CHECK(split({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 1, 0}}).size() == 1);
  CHECK(split({}).empty());
}

TEST_CASE("Polygons that cross themselves or have no area are cut without end") {
  CHECK(split({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}).size() == 2);
  CHECK(split({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {1.5, 0, 0}}).size() == 3);
}

}  // namespace rangezip
