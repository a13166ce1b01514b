#include "core/mesh/places.h"

#include <catch2/catch.hpp>
#include <limits>

#include "core/base/error.h"

using namespace rangezip;

TEST_CASE("points within reach of each other make one place, others do not", "[mesh]") {
  const std::vector<Vec3> points{{10.0, 0.0, 0.0}, {0.0, 0.0, 0.0},  {0.9, 0.0, 0.0},
                                 {1.8, 0.0, 0.0},  {10.0, 0.5, 0.0}, {-20.0, 3.0, 7.0}};
  const std::vector<double> areas{1.0, 2.0, 3.0, 4.0, 5.0, 6.0};
  const std::vector<Place> places = places_of(points, areas, 1.0);
  REQUIRE(places.size() == 3);
  CHECK(places[0].points == 3);
  CHECK(places[0].area == 9.0);
  CHECK(places[0].center.x == Approx(0.9));
  CHECK(places[0].radius == Approx(0.9));
  CHECK(places[1].points == 2);
  CHECK(places[1].area == 6.0);
  CHECK(places[2].center == Vec3{-20.0, 3.0, 7.0});
  CHECK(places[2].radius == 0.0);
}

TEST_CASE("a place does not depend on where the cubes of the search lie", "[mesh]") {
  const double shift = GENERATE(0.0, 0.3, -0.7, 1234.5);
  CAPTURE(shift);
  std::vector<Vec3> points;
  for (int i = 0; i < 40; ++i)
    points.emplace_back(shift + 0.95 * i, shift - 0.95 * i, shift);
  const std::vector<double> areas(points.size(), 1.0);
  CHECK(places_of(points, areas, 1.0).size() == 1);
}

TEST_CASE("places_of refuses a reach that is no length and areas that do not match", "[mesh]") {
  CHECK(places_of({}, {}, 1.0).empty());
  const std::vector<Vec3> point{{0.0, 0.0, 0.0}};
  CHECK_THROWS_AS(places_of(point, {}, 1.0), InvalidArgument);
  for (const double reach : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    CAPTURE(reach);
    CHECK_THROWS_AS(places_of({}, {}, reach), InvalidArgument);
  }
}
