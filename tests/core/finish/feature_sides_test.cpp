#include "core/finish/feature_sides.h"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>

namespace rangezip {
namespace {

FeatureSide plane(const Vec3& normal, double distance, double weight = 1.0) {
  return {{-distance, glm::normalize(normal), Mat3(0.0)}, weight};
}

TEST_CASE("planes meet where the closed form says, nearest to the origin") {
  const std::array one{plane({0, 0, 2}, 0.5)};
  REQUIRE(glm::distance(*meeting_place(one), Vec3(0, 0, 0.5)) < 1e-14);
  const std::array edge{plane({1, 0, 0}, 0.3), plane({0, 1, 0}, -0.2)};
  REQUIRE(glm::distance(*meeting_place(edge), Vec3(0.3, -0.2, 0)) < 1e-14);
  const std::array corner{plane({1, 0, 0}, 1.0), plane({1, 1, 0}, 0.0), plane({1, 1, 1}, 0.0)};
  REQUIRE(glm::distance(*meeting_place(corner), Vec3(1, -1, 0)) < 1e-12);
}

TEST_CASE("a plane and a sphere meet on their circle up to the third order") {
  // The sphere of radius 10 around (0, 0, -10) and the plane x = 0.4.
  const FeatureSide sphere{{0.0, {0, 0, 1}, Mat3(Vec3(-0.1, 0, 0), Vec3(0, -0.1, 0), Vec3(0.0))},
                           1.0};
  const std::array sides{sphere, plane({1, 0, 0}, 0.4)};
  const Vec3 place = *meeting_place(sides);
  REQUIRE(place.x == Approx(0.4));
  REQUIRE(std::abs(glm::distance(place, Vec3(0, 0, -10)) - 10.0) < 1e-4);
}

TEST_CASE("sides that are alike, or three along one line, meet nowhere") {
  const std::array alike{plane({0, 0, 1}, 0.1), plane({0, 0.01, 1}, 0.2)};
  REQUIRE_FALSE(meeting_place(alike));
  const std::array fan{plane({1, 0, 0}, 0.1), plane({0, 1, 0}, 0.1), plane({1, 1, 0}, 0.3)};
  REQUIRE_FALSE(meeting_place(fan));
}

TEST_CASE("more than three sides meet nowhere", "[finish]") {
  const std::array four{plane({1, 0, 0}, 0.1), plane({0, 1, 0}, 0.1), plane({0, 0, 1}, 0.1),
                        plane({1, 1, 1}, 0.1)};
  REQUIRE_FALSE(meeting_place(four));
}

TEST_CASE("surfaces are grouped by direction and by height, the heaviest group first") {
  const std::vector<FeatureSide> sides = sides_of(
      {plane({0, 0, 1}, 0.00, 1.0), plane({0, 0.1, 1}, 0.02, 1.0), plane({1, 0, 0}, 0.00, 3.0),
       plane({0, 0, 1}, 0.50, 1.0), plane({0, 1, 0}, 0.00, 0.01)},
      0.2);
  REQUIRE(sides.size() == 3);  // the last has hardly any weight
  REQUIRE(sides[0].weight == Approx(3.0));
  REQUIRE(sides[1].weight == Approx(2.0));
  REQUIRE(sides[1].height.constant == Approx(-0.01));
  REQUIRE(sides[2].height.constant == Approx(-0.5));
}

TEST_CASE("a height seen from another place is the same height") {
  const SurfaceHeight height{
      0.3, {0.1, -0.2, 0.97}, Mat3(Vec3(0.5, 0.1, 0), Vec3(0.1, -0.4, 0), Vec3(0, 0, 0.2))};
  const Vec3 from(0.3, 0.7, -0.1), p(-0.2, 0.4, 0.9);
  REQUIRE(height.seen_from(from).at(p) == Approx(height.at(from + p)));
  REQUIRE(glm::distance(height.seen_from(from).slope_at(p), height.slope_at(from + p)) < 1e-14);
}

}  // namespace
}  // namespace rangezip
