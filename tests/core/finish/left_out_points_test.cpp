#include "core/finish/left_out_points.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

using namespace rangezip;

namespace {

constexpr double kDistance = 1.0;
constexpr double kSide = 100.0;
constexpr std::uint64_t kSeed = 7;

/// A square of the given side at z = 0.
TriangleMesh square() {
  return {{{0, 0, 0}, {kSide, 0, 0}, {kSide, kSide, 0}, {0, kSide, 0}}, {{0, 1, 2}, {0, 2, 3}}};
}

/// Points over the square at a height with noise.
std::vector<Vec3> points_at(double height, double noise, std::size_t count) {
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> place(0.0, kSide);
  std::normal_distribution<double> off(0.0, noise);
  std::vector<Vec3> points(count);
  for (Vec3& p : points)
    p = {place(random), place(random), height + (noise > 0.0 ? off(random) : 0.0)};
  return points;
}

}  // namespace

TEST_CASE("points of a sheet that the mesh lacks are left out, all of them", "[reconstruct]") {
  const std::size_t count = 20'000;
  const double height = GENERATE(1.5, 3.0, 1000.0);
  std::vector<Vec3> points = points_at(0.0, 0.1, count);
  const std::vector<Vec3> other = points_at(height, 0.0, count);
  points.insert(points.end(), other.begin(), other.end());
  const std::vector<Vec3> left_out = left_out_points(points, square(), kDistance);
  if (height > 3.0 * kDistance) {
    CHECK(left_out == other);
  } else {  // half of what is around a point is of the covered sheet, now more, now less
    CHECK(left_out.size() > count / 2);
    CHECK(std::all_of(left_out.begin(), left_out.end(),
                      [&](const Vec3& p) { return p.z == height; }));
  }
}

TEST_CASE("the tails of noise are not left out", "[reconstruct]") {
  const std::vector<Vec3> points = points_at(0.0, 0.43, 40'000);
  const auto far = std::count_if(points.begin(), points.end(),
                                 [](const Vec3& p) { return std::abs(p.z) > kDistance; });
  REQUIRE(far > 400);  // one in fifty
  CHECK(left_out_points(points, square(), kDistance).size() < static_cast<std::size_t>(far) / 20);
}

TEST_CASE("of an empty mesh all points are left out", "[reconstruct]") {
  const std::vector<Vec3> points = points_at(0.0, 0.1, 100);
  CHECK(left_out_points(points, {}, kDistance) == points);
}

TEST_CASE("a hundred thousand points in one place cost no more than their number",
          "[reconstruct]") {
  const std::size_t pile = 100'000;
  const double height = GENERATE(0.5, 30.0);
  std::vector<Vec3> points = points_at(0.0, 0.1, 20'000);
  points.insert(points.end(), pile, Vec3(50.0, 50.0, height));
  points.push_back({50.0, 50.0, 1e30});  // farther away than a cube has a number
  const std::vector<Vec3> left_out = left_out_points(points, square(), kDistance);
  CHECK(left_out.size() == (height > kDistance ? pile + 1 : 1));
}
