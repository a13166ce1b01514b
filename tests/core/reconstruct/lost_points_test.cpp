#include "core/reconstruct/lost_points.h"

#include <catch2/catch.hpp>
#include <vector>

using namespace rangezip;

TEST_CASE("lost are the new uncovered points of places with over four times as many") {
  const std::vector<Sphere> places{{{0, 0, 0}, 1.0}, {{10, 0, 0}, 1.0}};
  const Vec3 known{0.5, 0, 0};
  std::vector<Vec3> after{known, {0.1, 0, 0}, {0.2, 0, 0}, {0.3, 0, 0}};
  after.emplace_back(5, 0, 0);                                          // in no place
  CHECK(lost_points(places, std::vector<Vec3>{known}, after).empty());  // four times as many
  after.emplace_back(0.4, 0, 0);
  CHECK(lost_points(places, std::vector<Vec3>{known}, after) ==
        std::vector<Vec3>{{0.1, 0, 0}, {0.2, 0, 0}, {0.3, 0, 0}, {0.4, 0, 0}});
  CHECK(lost_points(places, after, after).empty());
  // Each place is judged by itself.
  after.emplace_back(10.5, 0, 0);
  CHECK(lost_points(places, after, std::vector<Vec3>{}).empty());
  CHECK(lost_points(places, std::vector<Vec3>(3, known), after) == std::vector<Vec3>{{10.5, 0, 0}});
}
