#include "core/base/geometry.h"

#include <algorithm>
#include <array>
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
    const double length = random.between(0.0, 2.0);
    const Vec3 p = length * random.direction();
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

double distance_to_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 ab = b - a;
  const double squared = glm::dot(ab, ab);
  const double share = squared > 0.0 ? std::clamp(glm::dot(ab, p - a) / squared, 0.0, 1.0) : 0.0;
  return glm::length(a + share * ab - p);
}

/// A triangle in the plane z = 0: (0, 0), (1, 0) and (third, height), height >= 0. Distances to it
/// are exact to rounding however low it is, as no normal has to be found.
struct FlatTriangle {
  double third = 0.0;
  double height = 0.0;

  [[nodiscard]] double distance(const Vec3& p) const {
    const Vec2 a{0.0, 0.0};
    const Vec2 b{1.0, 0.0};
    const Vec2 c{third, height};
    const Vec2 q(p);
    const auto is_left = [&](const Vec2& u, const Vec2& v) {
      return (v.x - u.x) * (q.y - u.y) - (v.y - u.y) * (q.x - u.x) >= 0.0;
    };
    const bool is_inside = height > 0.0 && q.y >= 0.0 && is_left(b, c) && is_left(c, a);
    const double in_plane =
        is_inside ? 0.0
                  : std::min({distance_to_segment(q, a, b), distance_to_segment(q, b, c),
                              distance_to_segment(q, c, a)});
    return std::sqrt(in_plane * in_plane + p.z * p.z);
  }
};

/// Moves a FlatTriangle to a random place, gives the corners in random order, asks for the point
/// nearest to `flat_point`, and checks it. Moving rounds coordinates, all of which are below
/// `size`; distances change no more than that.
void check_closest_point(const FlatTriangle& flat, const Vec3& flat_point, shapes::Random& random) {
  const Vec3 x = random.direction();
  const Vec3 y = glm::normalize(glm::cross(x, random.direction()));
  const Mat3 rotation{x, y, glm::cross(x, y)};
  const Vec3 origin = random.direction();
  std::array<Vec3, 3> corners{origin, origin + x,
                              origin + rotation * Vec3{flat.third, flat.height, 0}};
  std::rotate(corners.begin(), corners.begin() + static_cast<int>(random.bits() % 3),
              corners.end());
  if (random.bits() % 2 == 0) std::swap(corners[0], corners[1]);
  const Vec3 point = origin + rotation * flat_point;

  const Vec3 closest = closest_point_on_triangle(point, corners[0], corners[1], corners[2]);
  const double size = 3.0 + glm::length(flat_point);
  constexpr double kRounding = 8.0 * std::numeric_limits<double>::epsilon();
  CHECK(flat.distance(glm::transpose(rotation) * (closest - origin)) <= kRounding * size);
  CHECK(std::abs(glm::length(closest - point) - flat.distance(flat_point)) <=
        1e-12 + kRounding * size);
}

TEST_CASE("closest_point_on_triangle is right for slivers and needles of any height", "[base]") {
  for (const double height : {0.0,  1e-300, 1e-16, 1e-15, 1e-14, 1e-13, 1e-12, 1e-11, 1e-10, 1e-9,
                              1e-8, 1e-7,   1e-6,  1e-5,  1e-4,  1e-3,  1e-2,  0.03,  0.1,   1.0}) {
    for (const double away : {0.0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3, 0.1, 1.0, 10.0, 1e3, 1e5}) {
      for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        CAPTURE(height, away, seed);
        shapes::Random random(seed);
        // The third corner above the base, beside it, or next to one of its ends.
        const std::array<double, 4> thirds{0.3, -0.5, random.unit(), 1.0 - height};
        const FlatTriangle flat{thirds[seed % 4], height};
        const bool is_above = seed % 8 < 4;
        Vec3 point{random.unit(), height * random.unit(), away};
        if (!is_above) {
          point = {random.between(-1, 2), height * random.unit(), 0.0};
          point += away * random.direction();
        }
        check_closest_point(flat, point, random);
      }
    }
  }
}

TEST_CASE("closest_point_on_triangle takes segments and points for triangles", "[base]") {
  const Vec3 a{0.1, 0.2, 0.3};
  const Vec3 b{1.1, 0.2, 0.7};
  const Vec3 p{0.3, -1.0, 1.0};  // its foot is between a and b
  CHECK(closest_point_on_triangle(p, a, a, a) == a);
  const Vec3 on_segment = a + (b - a) * (glm::dot(b - a, p - a) / glm::dot(b - a, b - a));
  for (const auto& [u, v, w] : {std::array{a, b, b}, std::array{a, a, b}, std::array{a, b, a}}) {
    // Rounding of coordinates of size 1.
    CHECK(glm::length(closest_point_on_triangle(p, u, v, w) - on_segment) < 1e-15);
  }
}

TEST_CASE("closest_point_on_triangle of a rounded point of a segment is on the segment", "[base]") {
  // The third corner is on the line between the others up to rounding: areas are noise.
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    CAPTURE(seed);
    shapes::Random random(seed);
    const Vec3 a = random.direction();
    const Vec3 b = random.direction();
    const Vec3 c = a + 0.3 * (b - a);
    const double length = random.between(0.0, 2.0);
    const Vec3 p = length * random.direction();
    const double share = std::clamp(glm::dot(b - a, p - a) / glm::dot(b - a, b - a), 0.0, 1.0);
    const double distance = glm::length(a + share * (b - a) - p);
    // A few roundings of coordinates up to 2.
    CHECK(glm::length(closest_point_on_triangle(p, a, b, c) - p) ==
          Approx(distance).margin(4e-15).epsilon(0));
  }
}

}  // namespace
}  // namespace rangezip
