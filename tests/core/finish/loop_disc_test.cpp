#include "core/finish/loop_disc.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace rangezip {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
const Vec3 kMiddle(3.0, -2.0, 1.0);

/// At these angles on a circle of radius 2 about kMiddle, in a plane across y.
std::vector<Vec3> on_circle(const std::vector<double>& angles) {
  std::vector<Vec3> points;
  for (const double a : angles)
    points.push_back(kMiddle + 2.0 * Vec3(std::sin(a), 0.0, std::cos(a)));
  return points;
}

std::vector<double> even_angles(int count) {
  std::vector<double> angles;
  for (int i = 0; i < count; ++i)
    angles.push_back(kTurn * i / count);
  return angles;
}

TEST_CASE("the disc of a circle has its middle, axis and area, however dense its corners are") {
  std::vector<double> angles = even_angles(360);
  const bool is_uneven = GENERATE(false, true);
  if (is_uneven) {
    angles.clear();
    for (int i = 0; i < 2000; ++i)  // most of them on one side
      angles.push_back(i < 1800 ? 0.5 * kTurn * i / 1800
                                : 0.5 * kTurn * (1.0 + (i - 1800) / 200.0));
  }
  const LoopDisc disc = disc_of_loop(on_circle(angles));
  CHECK(glm::length(disc.middle - kMiddle) < 1e-3);
  CHECK(glm::length(disc.axis - Vec3(0.0, 1.0, 0.0)) < 1e-3);
  CHECK(disc.radius == Approx(2.0).epsilon(1e-3));
}

TEST_CASE("toward the axis of a disc is straight to it, from wherever along it") {
  const LoopDisc disc = disc_of_loop(on_circle(even_angles(64)));
  const Vec3 place = kMiddle + Vec3(0.0, 7.0, 3.0);
  CHECK(glm::length(toward_axis(disc, place) - Vec3(0.0, 0.0, -1.0)) < 1e-9);
}

TEST_CASE("the middle of a disc is half as wide, and as far along its axis") {
  const LoopDisc disc = disc_of_loop(on_circle(even_angles(64)));
  const double radius = 0.5 * disc.radius;
  const auto count = [&](const Vec3& offset) {
    const std::vector<Vec3> points{kMiddle + radius * offset};
    const PointGrid grid(points, {kMiddle - Vec3(4.0), kMiddle + Vec3(4.0)}, 0.5);
    return points_in_middle(grid, disc);
  };
  CHECK(count({0.0, 0.0, 0.99}) == 1);
  CHECK(count({0.7, 0.99, 0.69}) == 1);
  CHECK(count({0.0, 0.0, 1.01}) == 0);
  CHECK(count({0.0, 1.01, 0.0}) == 0);
}

TEST_CASE("a circle on a wall with points is filled if some are in its middle, too") {
  std::vector<Vec3> points = on_circle(even_angles(200));
  const auto polygon = on_circle(even_angles(12));
  const LoopDisc disc = disc_of_loop(polygon);
  const Box region{kMiddle - Vec3(4.0), kMiddle + Vec3(4.0)};
  CHECK(!is_filled(PointGrid(points, region, 0.5), polygon, disc));
  for (int i = 0; i < 30; ++i)  // about 60 are as near to each corner
    points.push_back(kMiddle + Vec3(0.02 * i, 0.01 * i, 0.0));
  CHECK(is_filled(PointGrid(points, region, 0.5), polygon, disc));
}

TEST_CASE("a polygon to and fro encloses nothing") {
  const LoopDisc disc = disc_of_loop(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 0, 0}});
  CHECK(disc.radius == 0.0);
  CHECK(disc.axis == Vec3(0.0));
  CHECK(disc.middle == Vec3(1.0, 0.0, 0.0));
}

}  // namespace
}  // namespace rangezip
