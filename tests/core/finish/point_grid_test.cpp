#include "core/finish/point_grid.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

using testing::uniform;

TEST_CASE("for_each_near visits the points around, and has_point_within tells whether any is") {
  std::mt19937_64 engine(6);
  std::vector<Vec3> points;
  for (int i = 0; i < 2000; ++i) {
    points.push_back({uniform(engine, 0, 1), uniform(engine, 0, 1), uniform(engine, 0, 1)});
  }
  points.emplace_back(50.0, 0.0, 0.0);  // outside of the region
  const Box region{Vec3(-0.2), Vec3(1.2)};
  const double cell = GENERATE(0.02, 0.07, 0.5, 3.0);
  CAPTURE(cell);
  const PointGrid grid(points, region, cell);
  for (int i = 0; i < 200; ++i) {
    const Vec3 place{uniform(engine, -0.5, 1.5), uniform(engine, -0.5, 1.5),
                     uniform(engine, -0.5, 1.5)};
    constexpr double kRadius = 0.11;
    std::size_t expected = 0, found = 0;
    for (const Vec3& p : points)
      expected += glm::length(p - place) < kRadius ? 1 : 0;
    grid.for_each_near(place, kRadius,
                       [&](const Vec3& d) { found += glm::length(d) < kRadius ? 1 : 0; });
    REQUIRE(found == expected);  // positions are floats: none of these lies that close to the limit
    REQUIRE(grid.has_point_within(place, kRadius) == (expected > 0));
  }
}

TEST_CASE("points() gives all points, or fewer that are spread evenly") {
  std::vector<Vec3> points;
  for (int i = 0; i < 1000; ++i)
    points.emplace_back(0.001 * i, 0.0, 0.0);
  const PointGrid grid(points, {Vec3(-0.1), Vec3(1.1)}, 0.05);
  REQUIRE(grid.size() == 1000);
  REQUIRE(grid.points(1000).size() == 1000);
  const std::vector<Vec3> fewer = grid.points(250);
  REQUIRE(fewer.size() == 250);
  for (std::size_t i = 0; i < fewer.size(); ++i)
    REQUIRE(fewer[i].x == Approx(0.004 * static_cast<double>(i)).margin(1e-6));
}

TEST_CASE("a thinned grid has as many points in all, with the same mean, and fewer places") {
  std::mt19937_64 engine(7);
  std::vector<Vec3> points;
  for (int i = 0; i < 5000; ++i) {
    points.push_back({uniform(engine, 0, 1), uniform(engine, 0, 1), uniform(engine, 0, 1)});
  }
  const PointGrid grid(points, {Vec3(-0.1), Vec3(1.1)}, 0.2);
  const int parts = GENERATE(1, 2, 4);
  CAPTURE(parts);
  const PointGrid thin = grid.thinned(parts);
  Vec3 sum{0.0}, expected{0.0};
  for (const Vec3& p : points)
    expected += p;
  double count = 0.0;
  std::size_t places = 0;
  thin.for_each_counted_near(Vec3{0.0}, 10.0, Vec3{0.0, 0.0, 1.0}, [&](const Vec3& d, double n) {
    sum += n * d;
    count += n;
    ++places;
  });
  REQUIRE(count == 5000.0);
  REQUIRE(glm::length(sum - expected) < 1e-4 * glm::length(expected));  // positions are floats
  const int cells = 6 * parts + parts;
  REQUIRE(places <= static_cast<std::size_t>(cells * cells * cells));
  REQUIRE(places < points.size());
}

TEST_CASE("points that face away are left out, and a thinned grid keeps both sides apart") {
  std::mt19937_64 engine(8);
  std::vector<Vec3> points;  // two sheets, closer to each other than the parts that are thinned
  for (int i = 0; i < 4000; ++i) {
    const double z = i % 2 == 0 ? 0.0 : 0.01;
    points.push_back({uniform(engine, 0, 1), uniform(engine, 0, 1), z});
  }
  PointGrid grid(points, {Vec3(-0.1), Vec3(1.1)}, 0.2);
  const Vec3 up{0.0, 0.0, 1.0};
  const auto count_of = [](const PointGrid& of, const Vec3& normal) {
    double count = 0.0;
    of.for_each_counted_near(Vec3(0.5), 2.0, normal, [&](const Vec3&, double n) { count += n; });
    return count;
  };
  CHECK(count_of(grid, up) == 4000.0);
  grid.note_facings([&](const Vec3& p) {
    if (p.x > 0.5) return Vec3(0.0);  // not known there
    return p.z > 0.005 ? up : -up;
  });
  const double lower = static_cast<double>(std::count_if(
      points.begin(), points.end(), [](const Vec3& p) { return p.z == 0.0 && !(p.x > 0.5); }));
  REQUIRE(lower > 900.0);
  CHECK(count_of(grid, up) == 4000.0 - lower);
  CHECK(count_of(grid, Vec3{1.0, 0.0, 0.0}) == 4000.0);
  const PointGrid thin = grid.thinned(2);
  CHECK(count_of(thin, up) == Approx(4000.0 - lower).margin(150.0));  // where known meets unknown
  thin.for_each_counted_near(Vec3{0.1, 0.5, 0.0}, 0.05, up, [&](const Vec3& d, double) {
    if (d.x < 0.1) CHECK(d.z == Approx(0.01).margin(1e-6));  // a mean of one side only
  });
}

}  // namespace
}  // namespace rangezip
