#include "compare/mesh_distance.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "tests/compare/cubes.h"

using namespace rangezip;
using namespace rangezip::compare;

namespace {

double distance_by_exhaustion(const Vec3& point, const TriangleMesh& mesh) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 foot =
        closest_point_on_triangle(point, mesh.positions[a], mesh.positions[b], mesh.positions[c]);
    nearest = std::min(nearest, glm::length(point - foot));
  }
  return nearest;
}

/// Triangles all over the unit cube, every third one a sliver of height 1e-9.
TriangleMesh random_triangles(shapes::Random& random, std::size_t count) {
  TriangleMesh mesh;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 a = test::random_point(random);
    const Vec3 b = test::random_point(random);
    const Vec3 c =
        i % 3 == 0 ? 0.5 * (a + b) + 1e-9 * test::random_point(random) : test::random_point(random);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {a, b, c});
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

}  // namespace

TEST_CASE("every point of a cube is 1 away from a cube that is 1 larger on each side") {
  const std::vector<double> distances =
      distances_to_mesh(sample_surface(test::cube(1.0), {.count = 20'000}), test::cube(2.0));
  const DistanceSummary summary = summarize(distances);
  CHECK(summary.count == 20'000);
  // A sample leaves its face by some roundings of coordinates of size 1.
  constexpr double kRounding = 1e-14;
  CHECK(std::abs(summary.mean - 1.0) < kRounding);
  CHECK(std::abs(summary.rms - 1.0) < kRounding);
  CHECK(std::abs(summary.p95 - 1.0) < kRounding);
  CHECK(std::abs(summary.max - 1.0) < kRounding);
  CHECK(share_within(distances, 0.999) == 0.0);
  CHECK(share_within(distances, 1.001) == 1.0);
}

TEST_CASE("the way back has the mean square that an integral gives") {
  // On the outer face z = 2: d^2 = 1 + max(|x|-1, 0)^2 + max(|y|-1, 0)^2, mean 1 + 2/6; at the
  // corners d^2 = 3. The deviation of d^2 is below 1, so that of the mean of n is below 1/sqrt(n).
  constexpr std::size_t kSamples = 40'000;
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    CAPTURE(seed);
    const std::vector<double> distances = distances_to_mesh(
        sample_surface(test::cube(2.0), {.count = kSamples, .seed = seed}), test::cube(1.0));
    const DistanceSummary summary = summarize(distances);
    CHECK(std::abs(summary.rms * summary.rms - 4.0 / 3.0) < 5.0 / std::sqrt(kSamples));
    CHECK(summary.max <= std::sqrt(3.0) + 1e-14);
    CHECK(summary.max > 1.7);
    CHECK(summary.mean <= summary.rms);
    CHECK(summary.p95 <= summary.max);
    CHECK(share_within(distances, summary.p95) >= 0.95);
  }
}

TEST_CASE("nearest_faces finds what trying all faces finds, slivers included") {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    CAPTURE(seed);
    shapes::Random random(seed);
    const TriangleMesh mesh = random_triangles(random, 60);
    std::vector<Vec3> points;
    for (int i = 0; i < 200; ++i)
      points.push_back(1.5 * test::random_point(random));
    const std::vector<NearestFace> nearest = nearest_faces(points, mesh);
    for (std::size_t i = 0; i < points.size(); ++i) {
      // The tree compares points that it has constructed with rounding, on slivers with some 1e9
      // of their relative error: 1e9 * 2^-53 is 1e-7.
      CHECK(std::abs(nearest[i].distance - distance_by_exhaustion(points[i], mesh)) < 1e-7);
    }
  }
}

TEST_CASE("faces without area are passed over") {
  TriangleMesh mesh = test::strip(1);
  mesh.triangles.insert(mesh.triangles.begin(), {0, 0, 1});
  const std::vector<Vec3> points{{0.75, 0.25, 2.0}};
  const std::vector<NearestFace> nearest = nearest_faces(points, mesh);
  REQUIRE(nearest.size() == 1);
  CHECK(nearest[0].face == 1);
  CHECK(nearest[0].distance == 2.0);
}

TEST_CASE("distances do not depend on the number of threads") {
  const std::vector<Vec3> points = sample_surface(test::cube(1.3), {.count = 5'000});
  std::vector<double> one;
  std::vector<double> two;
  run_with_threads(1, [&] { one = distances_to_mesh(points, test::cube(1.0)); });
  run_with_threads(2, [&] { two = distances_to_mesh(points, test::cube(1.0)); });
  CHECK(one == two);
}

TEST_CASE("samples lie on the surface, each face with its share of the area") {
  // Two squares, one of four times the area of the other.
  TriangleMesh mesh = test::together(test::cube(1.0), test::cube(2.0, {10.0, 0.0, 0.0}));
  constexpr std::size_t kSamples = 10'000;
  const std::vector<Vec3> samples = sample_surface(mesh, {.count = kSamples});
  REQUIRE(samples.size() == kSamples);
  const DistanceSummary on_surface = summarize(distances_to_mesh(samples, mesh));
  CHECK(on_surface.max < 1e-14);
  // One sample a strip of equal area: the smaller cube has exactly a fifth of the strips.
  const auto on_small = std::ranges::count_if(samples, [](const Vec3& p) { return p.x < 5.0; });
  CHECK(std::abs(static_cast<double>(on_small) - kSamples / 5.0) <= 1.0);
}

TEST_CASE("the same seed gives the same samples, another one others") {
  const TriangleMesh mesh = test::cube(1.0);
  const std::vector<Vec3> first = sample_surface(mesh, {.count = 100, .seed = 7});
  CHECK(first == sample_surface(mesh, {.count = 100, .seed = 7}));
  CHECK(first != sample_surface(mesh, {.count = 100, .seed = 8}));
}

TEST_CASE("a summary orders before it counts and is zero for nothing") {
  const std::vector<double> distances{4.0, 0.0, 3.0};
  const DistanceSummary summary = summarize(distances);
  CHECK(summary.mean == Approx(7.0 / 3.0));
  CHECK(summary.rms == Approx(std::sqrt(25.0 / 3.0)));
  CHECK(summary.p95 == 4.0);
  CHECK(summary.max == 4.0);
  CHECK(summarize({}).count == 0);
  CHECK(share_within({}, 1.0) == 1.0);

  std::vector<double> hundred;
  for (int i = 100; i >= 1; --i)
    hundred.push_back(i);
  CHECK(summarize(hundred).p95 == 95.0);
}

TEST_CASE("what cannot be measured is refused") {
  const std::vector<Vec3> point{{0.0, 0.0, 0.0}};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(nearest_faces(std::vector<Vec3>{{nan, 0.0, 0.0}}, test::cube(1.0)),
                  InvalidArgument);
  CHECK_THROWS_AS(nearest_faces(point, TriangleMesh{}), TopologyError);
  CHECK_THROWS_AS(sample_surface(TriangleMesh{}), TopologyError);

  TriangleMesh flat = test::strip(1);
  for (Vec3& p : flat.positions)
    p = Vec3{1.0};
  CHECK_THROWS_AS(nearest_faces(point, flat), TopologyError);
  CHECK_THROWS_AS(sample_surface(flat), TopologyError);

  TriangleMesh torn = test::strip(1);
  torn.triangles[0][2] = 99;
  CHECK_THROWS_AS(nearest_faces(point, torn), TopologyError);
  CHECK_THROWS_AS(sample_surface(torn), TopologyError);

  TriangleMesh infinite = test::strip(1);
  infinite.positions[1].y = std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(nearest_faces(point, infinite), TopologyError);
  CHECK_THROWS_AS(sample_surface(infinite), TopologyError);
}
