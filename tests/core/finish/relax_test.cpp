#include "core/finish/relax.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "core/finish/local_plane.h"
#include "core/finish/triangle_shape.h"
#include "core/mesh/mesh_report.h"
#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

using testing::uniform;

Vec3 direction(std::mt19937_64& engine) {
  for (;;) {
    const Vec3 p(uniform(engine, -1, 1), uniform(engine, -1, 1), uniform(engine, -1, 1));
    const double length = glm::length(p);
    if (length > 0.1 && length < 1.0) return p / length;
  }
}

TEST_CASE("the plane through points of a plane is that plane") {
  const std::uint64_t seed = GENERATE(1U, 2U, 3U, 4U);
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  const Vec3 normal = direction(engine);
  const Vec3 u = glm::normalize(glm::cross(normal, direction(engine)));
  const Vec3 v = glm::cross(normal, u);
  const Vec3 center = 3.0 * direction(engine);
  PlaneSums sums;
  for (int i = 0; i < 100; ++i) {
    sums.add(center + uniform(engine, -2, 2) * u + uniform(engine, -1, 1) * v,
             uniform(engine, 0, 1));
  }
  const LocalPlane plane = sums.plane();
  // Sums of squares of size 9 round at 1e-15 each.
  REQUIRE(std::abs(glm::dot(plane.normal, normal)) == Approx(1.0).margin(1e-12));
  REQUIRE(std::abs(glm::dot(plane.center - center, normal)) < 1e-12);
  REQUIRE(plane.thickness < 1e-12);
  // The narrower direction is uniform in [-1, 1]: variance 1/3, of 100 random points.
  REQUIRE(plane.width == Approx(1.0 / 3.0).epsilon(0.5));
}

TEST_CASE("the smallest eigenvalue is found for any order of the axes") {
  const int thin = GENERATE(0, 1, 2);
  CAPTURE(thin);
  PlaneSums sums;
  for (const double s : {-1.0, 1.0}) {
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 p{0.0};
      p[axis] = s * (axis == thin ? 0.1 : 1.0 + axis);
      sums.add(p, 1.0);
    }
  }
  const LocalPlane plane = sums.plane();
  REQUIRE(std::abs(plane.normal[thin]) == 1.0);
  REQUIRE(plane.thickness == Approx(2.0 * 0.01 / 6.0));
}

TEST_CASE("sine_of_smallest_angle is that of the smallest angle") {
  REQUIRE(sine_of_smallest_angle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}) == Approx(std::sqrt(0.5)));
  REQUIRE(sine_of_smallest_angle({0, 0, 0}, {2, 0, 0}, {1, std::sqrt(3.0), 0}) ==
          Approx(std::sqrt(0.75)));
  REQUIRE(sine_of_smallest_angle({0, 0, 0}, {1, 0, 0}, {2, 0, 0}) == 0.0);
  REQUIRE(sine_of_smallest_angle({1, 1, 1}, {1, 1, 1}, {1, 1, 1}) == 0.0);
}

/// A sphere whose vertices are pushed about along it and off it.
struct RoughSphere {
  TriangleMesh mesh;
  std::vector<Vec3> cloud;
  double h = 0.0;
};

RoughSphere rough_sphere(int n, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  RoughSphere rough{testing::sphere(n), {}, 1.6 / n};
  for (Vec3& p : rough.mesh.positions) {
    p = glm::normalize(p + 0.25 * rough.h * direction(engine));
    p *= 1.0 + uniform(engine, -0.1, 0.1) * rough.h;
  }
  const double spacing = rough.h / 2.2;
  const auto count = static_cast<std::size_t>(4.0 * 3.1416 / (spacing * spacing));
  for (std::size_t i = 0; i < count; ++i)
    rough.cloud.push_back(direction(engine));
  return rough;
}

TEST_CASE("relax brings a rough sphere back onto the sphere with better triangles") {
  const std::uint64_t seed = GENERATE(1U, 2U, 3U);
  CAPTURE(seed);
  RoughSphere rough = rough_sphere(24, seed);
  const double angle_before = testing::smallest_angle(rough.mesh);
  Box region = bounds_of(rough.mesh);
  const PointGrid cloud(rough.cloud, region, 0.7 * rough.h);
  const RelaxReport report = relax(rough.mesh, cloud, {rough.h, 5});
  remove_unused_vertices(rough.mesh);
  REQUIRE(report.flipped_edges > 0);
  REQUIRE(testing::smallest_angle(rough.mesh) > angle_before);
  REQUIRE(testing::smallest_angle(rough.mesh) > 0.35);  // 20 degrees
  REQUIRE(report_mesh(rough.mesh).is_manifold());
  REQUIRE(report_mesh(rough.mesh).euler == 2);
  // A plane through points of a sphere within radius 1.3 h lies less than their mean square
  // distance from the axis, at most (1.3 h)^2, over twice the radius below it.
  const double bound = 0.5 * 1.69 * rough.h * rough.h;
  double mean = 0.0;
  for (const Vec3& p : rough.mesh.positions) {
    REQUIRE(std::abs(glm::length(p) - 1.0) < 1.5 * bound);
    mean += std::abs(glm::length(p) - 1.0) / static_cast<double>(rough.mesh.positions.size());
  }
  REQUIRE(mean < 0.5 * bound);
}

TEST_CASE("relax keeps the boundary and does nothing to the topology") {
  RoughSphere rough = rough_sphere(20, 4);
  testing::cut_where(rough.mesh, [](const Vec3& p) { return p.z > 0.5; });
  const MeshReport before = report_mesh(rough.mesh);
  const PointGrid cloud(rough.cloud, bounds_of(rough.mesh), 0.7 * rough.h);
  relax(rough.mesh, cloud, {rough.h, 5});
  const MeshReport after = report_mesh(rough.mesh);
  REQUIRE(after.boundary_edges == before.boundary_edges);
  REQUIRE(after.longest_loop == before.longest_loop);
  REQUIRE(after.euler == before.euler);
  REQUIRE(after.is_manifold());
}

TEST_CASE("without a cloud relax evens out triangles within the surface") {
  RoughSphere rough = rough_sphere(16, 5);
  const double angle_before = testing::smallest_angle(rough.mesh);
  relax(rough.mesh, PointGrid({}, bounds_of(rough.mesh), 0.1), {rough.h, 5});
  REQUIRE(testing::smallest_angle(rough.mesh) > angle_before);
  for (const Vec3& p : rough.mesh.positions)
    REQUIRE(std::abs(glm::length(p) - 1.0) < 0.2 * rough.h);
}

TEST_CASE("for_each_near visits exactly the points around, and more") {
  std::mt19937_64 engine(6);
  std::vector<Vec3> points;
  for (int i = 0; i < 2000; ++i) {
    points.emplace_back(uniform(engine, 0, 1), uniform(engine, 0, 1), uniform(engine, 0, 1));
  }
  points.emplace_back(50.0, 0.0, 0.0);  // outside of the region
  const Box region{Vec3(-0.2), Vec3(1.2)};
  const double cell = GENERATE(0.02, 0.07, 0.5, 3.0);
  CAPTURE(cell);
  const PointGrid grid(points, region, cell);
  for (int i = 0; i < 200; ++i) {
    const Vec3 place(uniform(engine, -0.5, 1.5), uniform(engine, -0.5, 1.5),
                     uniform(engine, -0.5, 1.5));
    constexpr double kRadius = 0.11;
    std::size_t expected = 0, found = 0;
    for (const Vec3& p : points)
      expected += glm::length(p - place) < kRadius ? 1 : 0;
    grid.for_each_near(place, kRadius,
                       [&](const Vec3& d) { found += glm::length(d) < kRadius ? 1 : 0; });
    REQUIRE(found == expected);  // positions are floats: none of these lies that close to the limit
  }
}

}  // namespace
}  // namespace rangezip
