#include "core/plan/line_gap.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "core/plan/spacing.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

constexpr double kSide = 400.0;

/// Points on a square of side kSide, oblique in space.
Vec3 in_space(double x, double y, double height) {
  const Vec3 along = glm::normalize(Vec3{2.0, -1.0, 0.5});
  const Vec3 up = glm::normalize(glm::cross(along, Vec3{0.3, 0.2, 1.0}));
  return Vec3{5.0, 7.0, -3.0} + x * along + y * glm::cross(up, along) + height * up;
}

/// Lines with a point for each unit of their length, off their places by some noise.
std::vector<Vec3> lines(double gap, double noise, bool are_crossed, shapes::Random& random) {
  std::vector<Vec3> points;
  const auto add = [&](double x, double y) {
    const auto jitter = [&] { return random.between(-noise, noise); };
    points.push_back(in_space(x + jitter(), y + jitter(), jitter()));
  };
  for (double y = 0.0; y < kSide; y += gap) {
    for (double x = 0.0; x < kSide; x += 1.0) {
      add(x, y);
      if (are_crossed) add(y, x);
    }
  }
  return points;
}

std::vector<LinePlace> places_of(const std::vector<Vec3>& points) {
  std::vector<LinePlace> places;
  for (std::size_t i = 0; i < points.size(); i += points.size() / 150) {
    std::vector<double> distances;
    for (const Vec3& p : points)
      distances.push_back(glm::length(p - points[i]));
    std::nth_element(distances.begin(), distances.begin() + 16, distances.end());
    std::sort(distances.begin(), distances.begin() + 16);
    places.push_back({points[i], distances[4], distances[16]});
  }
  return places;
}

double line_gap_of(const std::vector<Vec3>& points) {
  return line_gap(points, places_of(points));
}

}  // namespace

TEST_CASE("the gap between scan lines is told to a quarter, straight or noisy") {
  const double gap = GENERATE(10.0, 14.0, 20.0);
  const double noise = GENERATE(0.0, 0.7);
  const std::uint64_t seed = GENERATE(range<std::uint64_t>(1, 4));
  CAPTURE(gap, noise, seed);
  shapes::Random random(seed);
  CHECK(line_gap_of(lines(gap, noise, false, random)) == Approx(gap).epsilon(0.25));
}

TEST_CASE("where lines cross, their gap is that of lines that leave holes as large") {
  // In a square of side g the squared distance from the nearest side is g^2 / 24 on average.
  shapes::Random random(1);
  const double gap = line_gap_of(lines(16.0, 0.5, true, random));
  CHECK(gap == Approx(16.0 / std::sqrt(2.0)).epsilon(0.15));
}

TEST_CASE("no lines are seen in a grid, in lines a few steps apart or in points at random") {
  const std::uint64_t seed = GENERATE(range<std::uint64_t>(1, 6));
  CAPTURE(seed);
  shapes::Random random(seed);
  CHECK(line_gap_of(lines(1.0, 0.0, false, random)) == 0.0);
  CHECK(line_gap_of(lines(3.0, 0.5, false, random)) == 0.0);
  std::vector<Vec3> points;
  for (int i = 0; i < 20'000; ++i)
    points.push_back(in_space(kSide * random.unit(), kSide * random.unit(), random.unit()));
  CHECK(line_gap_of(points) == 0.0);
  const auto on_torus = shapes::to_points(shapes::sampled(shapes::torus(), 20'000, seed));
  CHECK(line_gap_of(on_torus) == 0.0);
}

TEST_CASE("a cloud of too few points has no scan lines") {
  CHECK(line_gap({}, {}) == 0.0);
  const std::vector<Vec3> two{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}};
  CHECK(line_gap(two, std::vector<LinePlace>{{two[0], 0.0, 0.0}}) == 0.0);
}

TEST_CASE("pixels for noisy scan lines leave hardly two empty rows between lines") {
  shapes::Random random(3);
  const Spacing spacing = estimate_spacing(lines(10.0, 0.7, false, random));
  REQUIRE(spacing.gap == 0.0);
  CHECK(spacing.line_gap == Approx(10.0).epsilon(0.2));
  CHECK(pixel_size_from_spacing(spacing) >= 0.9 * spacing.line_gap);
  CHECK(pixel_size_from_spacing(spacing) <= 1.2 * spacing.line_gap);
}

}  // namespace rangezip
