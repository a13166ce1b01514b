#include "core/plan/places_over_surface.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

#include "tests/support/shapes.h"

namespace rangezip {
namespace {

/// Thrown at random into [from, from + 1) x [0, 1), at this height.
void add_square(std::vector<Vec3>& points, double from, std::size_t count, shapes::Random& random) {
  for (std::size_t i = 0; i < count; ++i)
    points.emplace_back(from + random.unit(), random.unit(), 0.0);
}

TEST_CASE("places are spread over the surface, not over the points, and none is an outlier") {
  const std::uint64_t seed = GENERATE(range<std::uint64_t>(1, 6));
  CAPTURE(seed);
  shapes::Random random(seed);
  std::vector<Vec3> points;
  add_square(points, 0.0, 100'000, random);
  add_square(points, 1.0, 2'000, random);
  for (int i = 0; i < 100; ++i)
    points.emplace_back(2.0 * random.unit(), random.unit(), 0.2 + random.unit());
  Box box;
  for (const Vec3& p : points)
    box.add(p);

  const std::vector<Vec3> places = places_over_surface(points, box, 60);

  REQUIRE(places.size() == 60);
  const auto count_if = [&](const auto& is_one) {
    return std::count_if(places.begin(), places.end(), is_one);
  };
  CHECK(count_if([](const Vec3& p) { return p.z == 0.0 && p.x < 1.0; }) >= 24);
  CHECK(count_if([](const Vec3& p) { return p.z == 0.0 && p.x >= 1.0; }) >= 24);
  CHECK(count_if([](const Vec3& p) { return p.z > 0.0; }) <= 6);
}

TEST_CASE("where all points are at one place there are no places over a surface") {
  const std::vector<Vec3> points(10, Vec3(1.0, 2.0, 3.0));
  Box box;
  box.add(points[0]);
  CHECK(places_over_surface(points, box, 300).empty());
}

}  // namespace
}  // namespace rangezip
