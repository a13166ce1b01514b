#include "core/reconstruct/coverage_report.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cstdint>
#include <numbers>

#include "tests/support/shapes.h"

using namespace rangezip;

namespace {

constexpr double kPixel = 0.05;
constexpr double kPi = std::numbers::pi;

std::vector<Vec3> points_of_sphere() {
  return shapes::to_points(shapes::sampled(shapes::sphere(), 40'000, 5));
}

bool is_in_cap(const Vec3& p) {
  return p.z > 0.9;
}
/// Of the part of the unit sphere above z = 0.9.
constexpr double kCapArea = 2.0 * kPi * 0.1;

TriangleMesh sphere_without_cap() {
  TriangleMesh mesh = shapes::to_mesh(shapes::sphere(1.0, 96));
  std::erase_if(mesh.triangles, [&](const Triangle& t) {
    return std::any_of(t.begin(), t.end(), [&](auto v) { return is_in_cap(mesh.positions[v]); });
  });
  return mesh;
}

}  // namespace

TEST_CASE("a whole sphere leaves nothing to report", "[reconstruct]") {
  const CoverageReport report =
      report_coverage({points_of_sphere()}, shapes::to_mesh(shapes::sphere(1.0, 96)), kPixel);
  CHECK(report.share == 1.0);
  CHECK(report.uncovered_points == 0);
  CHECK(report.uncovered.empty());
  CHECK(report.unsupported.empty());
}

TEST_CASE("the tails of noise are no places, however many points they have", "[reconstruct]") {
  std::vector<Vec3> points = shapes::to_points(shapes::sampled(shapes::sphere(), 400'000, 5));
  shapes::Random random(11);
  for (Vec3& p : points)
    p *= 1.0 + 0.4 * kPixel * random.normal();
  const CoverageReport report =
      report_coverage({points}, shapes::to_mesh(shapes::sphere(1.0, 96)), kPixel);
  CHECK(report.share == Approx(0.99).margin(0.003));  // within 2.5 deviations
  CHECK(report.uncovered.empty());
  CHECK(report.uncovered_area == 0.0);
  CHECK(report.scattered_points == report.uncovered_points);
}

TEST_CASE("a part of the cloud without a mesh is one place of its area", "[reconstruct]") {
  std::vector<Vec3> points = points_of_sphere();
  points.emplace_back(5.0, 0.0, 0.0);  // an outlier
  const CoverageReport report = report_coverage({points}, sphere_without_cap(), kPixel);
  // Along the rim some of the points just off the mesh are among more that have a face.
  CHECK(report.scattered_points >= 1);
  CHECK(report.scattered_points < report.uncovered_points / 50);
  REQUIRE(report.uncovered.size() == 1);
  const Place& place = report.uncovered.front();
  CHECK(place.points == report.uncovered_points - report.scattered_points);
  // The points within a pixel of the rim are covered: of the cap, r = 0.44, about a fifth.
  CHECK(place.area > 0.7 * kCapArea);
  CHECK(place.area < kCapArea);
  CHECK(report.uncovered_area == place.area);
  CHECK(glm::length(Vec2(place.center)) < 0.02);
  CHECK(place.center.z > 0.9);
  CHECK(place.radius < 0.46);
}

TEST_CASE("points in one place stand for no more area than it has room for", "[reconstruct]") {
  std::vector<Vec3> points = points_of_sphere();
  const std::size_t pile = 10'000;  // a quarter of the sphere
  points.insert(points.end(), pile, Vec3(0.5 * kPixel));
  const CoverageReport report =
      report_coverage({points}, shapes::to_mesh(shapes::sphere(1.0, 96)), kPixel);
  REQUIRE(report.uncovered.size() == 1);
  CHECK(report.uncovered.front().points == pile);
  CHECK(report.uncovered_area > 0.0);
  CHECK(report.uncovered_area < 2.01 * kPixel * kPixel);
}

TEST_CASE("a part of the mesh without points is one place of its area", "[reconstruct]") {
  std::vector<Vec3> points = points_of_sphere();
  std::erase_if(points, is_in_cap);
  const CoverageReport report =
      report_coverage({points}, shapes::to_mesh(shapes::sphere(1.0, 96)), kPixel);
  CHECK(report.share == 1.0);
  REQUIRE(report.unsupported.size() == 1);
  CHECK(report.unsupported_area > 0.6 * kCapArea);
  CHECK(report.unsupported_area < kCapArea);
  CHECK(report.unsupported.front().center.z > 0.9);
}

TEST_CASE("a part of the mesh that hides points which look out is one place of its area",
          "[reconstruct]") {
  constexpr double kFloor = 0.3;  // of a hollow below the cap
  std::vector<Vec3> points = points_of_sphere();
  std::erase_if(points, is_in_cap);
  std::vector<std::array<std::int8_t, 3>> votes;
  for (const Vec3& p : points) {
    const auto along = [&](int axis) { return static_cast<std::int8_t>(127.0 * p[axis]); };
    votes.push_back({along(0), along(1), along(2)});
  }
  shapes::Random random(1);
  for (int i = 0; i < 4000; ++i) {
    points.emplace_back(random.between(-0.5, 0.5), random.between(-0.5, 0.5), kFloor);
    votes.push_back({0, 0, 40});
  }
  const TriangleMesh mesh = shapes::to_mesh(shapes::sphere(1.0, 96));
  CHECK(report_coverage({points}, mesh, kPixel).papered.empty());
  const CoverageReport report = report_coverage({points, votes}, mesh, kPixel);
  REQUIRE(report.papered.size() == 1);
  CHECK(report.papered_area == report.papered.front().area);
  CHECK(report.papered_area > 0.6 * kCapArea);
  CHECK(report.papered_area < kCapArea);
  CHECK(report.papered.front().center.z > 0.9);
}

TEST_CASE("without a mesh nothing is covered, and without points nothing is missing",
          "[reconstruct]") {
  CHECK(report_coverage({}, sphere_without_cap(), kPixel).share == 1.0);
  const CoverageReport report = report_coverage({points_of_sphere()}, TriangleMesh{}, kPixel);
  CHECK(report.share == 0.0);
  CHECK(report.uncovered_points == 40'000);
}
