#include "core/base/geometry.h"

#include <limits>

#include <catch2/catch.hpp>

#include "tests/support/shapes.h"

namespace rangezip {
namespace {

TEST_CASE("a box is empty until something is added", "[base]") {
  Box box;
  CHECK(box.is_empty());
  CHECK(box.diagonal() == 0.0);
  box.add(Box{});
  CHECK(box.is_empty());
  box.add(Vec3{1, 2, 3});
  CHECK_FALSE(box.is_empty());
  CHECK(box.diagonal() == 0.0);
  Box other;
  other.add(Vec3{-1, 0, 5});
  box.add(other);
  CHECK(box.lower == Vec3{-1, 0, 3});
  CHECK(box.upper == Vec3{1, 2, 5});
  CHECK(box.center() == Vec3{0, 1, 4});
  CHECK(box.diagonal() == Approx(std::sqrt(12.0)));
}

TEST_CASE("the area vector is normal, as long as twice the area, and follows the winding",
          "[base]") {
  const Vec3 area = area_vector({0, 0, 0}, {2, 0, 0}, {0, 3, 0});
  CHECK(area == Vec3{0, 0, 6});
  CHECK(area_vector({0, 0, 0}, {0, 3, 0}, {2, 0, 0}) == -area);
}

TEST_CASE("unit_or_z has a fallback for what has no direction", "[base]") {
  const double inf = std::numeric_limits<double>::infinity();
  CHECK(unit_or_z({0, -2, 0}) == Vec3{0, -1, 0});
  CHECK(unit_or_z({0, 0, 0}) == Vec3{0, 0, 1});
  CHECK(unit_or_z({inf, 0, 0}) == Vec3{0, 0, 1});
  CHECK(unit_or_z({std::numeric_limits<double>::quiet_NaN(), 0, 0}) == Vec3{0, 0, 1});
}

TEST_CASE("a plane's value is positive on the side that stays", "[base]") {
  const Plane plane{.normal = {0, 0, 2}, .offset = -2};
  CHECK(plane.value({5, 5, 3}) == 4.0);
  CHECK(plane.value({5, 5, 1}) == 0.0);
  CHECK(plane.value({5, 5, 0}) == -2.0);
}

/// Nearest distance by a dense grid of points of the triangle; at most one grid step too long.
double sampled_distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c, int steps) {
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; i + j <= steps; ++j) {
      const double u = static_cast<double>(i) / steps;
      const double v = static_cast<double>(j) / steps;
      best = std::min(best, glm::length(a + u * (b - a) + v * (c - a) - p));
    }
  }
  return best;
}

TEST_CASE("closest_point_on_triangle is on the triangle and nearest to the point", "[base]") {
  constexpr int kSteps = 60;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    CAPTURE(seed);
    shapes::Random random(seed);
    const Vec3 a = random.direction();
    const Vec3 b = random.direction();
    const Vec3 c = random.direction();
    const Vec3 p = random.between(0.0, 2.0) * random.direction();
    const Vec3 q = closest_point_on_triangle(p, a, b, c);
    const double distance = glm::length(q - p);
    const double longest = std::max({glm::length(b - a), glm::length(c - a), glm::length(c - b)});
    REQUIRE(distance <= sampled_distance(p, a, b, c, kSteps) + 1e-12);
    REQUIRE(distance >= sampled_distance(p, a, b, c, kSteps) - 2.0 * longest / kSteps);
    // On the triangle: its own closest point.
    REQUIRE(glm::length(closest_point_on_triangle(q, a, b, c) - q) < 1e-9);
  }
}

TEST_CASE("closest_point_on_triangle gives corners exactly", "[base]") {
  const Vec3 a{0.1, 0.2, 0.3};
  const Vec3 b{1.1, 0.2, 0.7};
  const Vec3 c{0.3, 1.9, 0.1};
  CHECK(closest_point_on_triangle({-5, -5, 0}, a, b, c) == a);
  CHECK(closest_point_on_triangle({9, -3, 1}, a, b, c) == b);
  CHECK(closest_point_on_triangle({0, 9, 0}, a, b, c) == c);
}

}  // namespace
}  // namespace rangezip
