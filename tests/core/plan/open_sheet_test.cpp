#include "core/plan/open_sheet.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <utility>

#include "core/base/error.h"
#include "raster_cpu/cpu_rasterizer.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

bool is_sheet(const std::vector<Vec3>& points) {
  CpuRasterizer rasterizer;
  return is_open_sheet(rasterizer, points);
}

std::vector<Vec3> points_on(const TriangleSoup& soup, std::size_t count = 40'000) {
  return shapes::to_points(shapes::sampled(shapes::moved(soup, shapes::tilt()), count));
}

/// A hilly square, random points.
std::vector<Vec3> terrain() {
  shapes::Random random(3);
  std::vector<Vec3> points;
  for (int i = 0; i < 40'000; ++i) {
    const double x = random.between(-1, 1), y = random.between(-1, 1);
    points.emplace_back(x, y, 0.1 * std::sin(5.0 * x) * std::cos(7.0 * y));
  }
  return points;
}

/// A slab with deep narrow grooves on both sides, in which most of its surface lies.
std::vector<Vec3> grooved_slab() {
  constexpr double kLength = 2.0, kWidth = 0.4, kPitch = 0.05, kDepth = 0.08, kCore = 0.03;
  shapes::Random random(4);
  std::vector<Vec3> points;
  while (points.size() < 60'000) {
    const double x = random.between(0, kLength), y = random.between(0, kWidth);
    const double side = random.unit() < 0.5 ? -1.0 : 1.0;
    const double place = std::fmod(x, kPitch);
    if (random.unit() < 0.25) {
      points.emplace_back(x, y, side * (kCore + (place < 0.5 * kPitch ? kDepth : 0.0)));
    } else {
      const double wall = x - place + (random.unit() < 0.5 ? 0.0 : 0.5 * kPitch);
      points.emplace_back(wall, y, side * (kCore + random.between(0, kDepth)));
    }
  }
  return points;
}

}  // namespace

TEST_CASE("is_open_sheet: the two sides of a body show different points") {
  const std::vector<std::pair<std::string, std::vector<Vec3>>> bodies{
      {"sphere", points_on(shapes::sphere())},    {"cube", points_on(shapes::cube())},
      {"torus", points_on(shapes::torus())},      {"trefoil", points_on(shapes::trefoil())},
      {"pocket", points_on(shapes::pocket(1.0))}, {"grooved slab", grooved_slab()}};
  for (const auto& [name, points] : bodies) {
    INFO(name);
    CHECK_FALSE(is_sheet(points));
  }
}

TEST_CASE("is_open_sheet: a body stays one where a side of it is missing") {
  // Three quarters of a sphere show their inside through the opening from few directions.
  std::vector<Vec3> points;
  for (const Vec3& p : shapes::to_points(shapes::sampled(shapes::sphere(), 40'000))) {
    if (p.z < 0.5) points.push_back(p);
  }
  CHECK_FALSE(is_sheet(points));
}

TEST_CASE("is_open_sheet: both sides of a terrain and of a half sphere show the same points") {
  CHECK(is_sheet(terrain()));
  CHECK(is_sheet(points_on(shapes::bowl())));
}

TEST_CASE("is_open_sheet refuses fewer points than make a plane") {
  CHECK_THROWS_AS(is_sheet({Vec3(0.0), Vec3(1.0)}), InvalidArgument);
}

}  // namespace rangezip
