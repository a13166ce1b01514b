#include "core/finish/fit_faces.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "core/base/parallel.h"
#include "core/finish/corner_table.h"
#include "core/finish/triangle_shape.h"
#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

using testing::uniform;

constexpr double kReach = 0.3;

double squared_distance(const TriangleMesh& mesh, const Vec3& p) {
  double least = kReach * kReach;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 d = closest_point_on_triangle(p, mesh.positions[t[0]], mesh.positions[t[1]],
                                             mesh.positions[t[2]]) -
                   p;
    least = std::min(least, glm::dot(d, d));
  }
  return least;
}

double mean_square(const TriangleMesh& mesh, const std::vector<Vec3>& points) {
  double sum = 0.0;
  for (const Vec3& p : points)
    sum += squared_distance(mesh, p);
  return sum / static_cast<double>(points.size());
}

/// Of the smallest angle of each face, in order.
std::vector<double> sorted_sines(const TriangleMesh& mesh) {
  std::vector<double> sines;
  for (const Triangle& t : mesh.triangles)
    sines.push_back(
        sine_of_smallest_angle(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]));
  std::sort(sines.begin(), sines.end());
  return sines;
}

double smallest_sine(const TriangleMesh& mesh) {
  return sorted_sines(mesh).front();
}

double median_sine(const TriangleMesh& mesh) {
  return sorted_sines(mesh)[mesh.triangles.size() / 2];
}

/// A sphere with waves, which pull vertices to their crests and into their valleys.
std::vector<Vec3> wavy_points(std::mt19937_64& engine) {
  std::vector<Vec3> points = testing::sphere_points(0.02, 0.0, engine);
  for (Vec3& p : points)
    p *= 1.0 + 0.03 * std::sin(9.0 * p.x) * std::sin(9.0 * p.y) * std::sin(9.0 * p.z);
  return points;
}

/// Spread evenly over the surface of the cube [-1, 1]^3.
std::vector<Vec3> cube_points(std::size_t count, std::mt19937_64& engine) {
  std::vector<Vec3> points(count);
  for (std::size_t i = 0; i < count; ++i) {
    for (int axis = 0; axis < 3; ++axis)
      points[i][axis] = uniform(engine, -1.0, 1.0);
    points[i][static_cast<int>(i % 3)] = i % 2 == 0 ? 1.0 : -1.0;
  }
  return points;
}

TEST_CASE("faces come to lie on a sphere with a tenth of the squared error of corners on it") {
  std::mt19937_64 engine(1);
  const std::vector<Vec3> points = testing::sphere_points(0.05, 0.0, engine);
  TriangleMesh mesh = testing::sphere(8);
  const double before = mean_square(mesh, points);
  fit_faces(mesh, points, {.reach = kReach});
  REQUIRE(mean_square(mesh, points) < before / 10.0);
}

TEST_CASE("single points off the surface, one in a hundred, hardly move the faces") {
  const std::uint64_t seed = GENERATE(range<std::uint64_t>(1, 4));
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  const std::vector<Vec3> points = testing::sphere_points(0.02, 0.0, engine);
  std::vector<Vec3> strayed = points;
  for (std::size_t i = 0; i < points.size(); i += 100)
    strayed.push_back(uniform(engine, 1.03, 1.09) * points[i]);
  TriangleMesh mesh = testing::sphere(30), of_strayed = mesh;
  fit_faces(mesh, points, {.reach = 0.1});
  fit_faces(of_strayed, strayed, {.reach = 0.1});
  CHECK(mean_square(of_strayed, points) < 15.0 * mean_square(mesh, points));
}

TEST_CASE("vertices slide onto the edges of a cube that the mesh cuts off") {
  std::mt19937_64 engine(2);
  TriangleMesh mesh = testing::cube(9);
  for (Vec3& p : mesh.positions) {
    // Towards the middle: what lies on an edge or at a corner gets off both sides.
    const auto is_outer = [&](int axis) { return std::abs(p[axis]) > 0.99; };
    if (is_outer(0) + is_outer(1) + is_outer(2) > 1) p *= 0.95;
  }
  const std::vector<Vec3> points = cube_points(12'000, engine);
  const double before = mean_square(mesh, points);
  fit_faces(mesh, points, {.reach = kReach});
  REQUIRE(mean_square(mesh, points) < before / 100.0);
}

TEST_CASE("a cube stays a cube where no point tells of its sides") {
  std::mt19937_64 engine(6);
  TriangleMesh mesh = testing::cube(9);
  for (Vec3& p : mesh.positions) {
    // Within the sides: edges would turn, and vertices would be evened out.
    for (int axis = 0; axis < 3; ++axis) {
      const double by = uniform(engine, -0.05, 0.05);
      if (std::abs(p[axis]) < 0.99) p[axis] += by;
    }
  }
  const TriangleMesh before = mesh;
  std::vector<Vec3> points = cube_points(12'000, engine);
  std::erase_if(points, [](const Vec3& p) { return p.x < 0.999; });
  fit_faces(mesh, points, {.reach = kReach});
  REQUIRE(mesh.positions != before.positions);
  CHECK(testing::volume_of(mesh) == Approx(8.0).epsilon(0.001));
  for (const Vec3& p : mesh.positions) {
    const double farthest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    CHECK(farthest == Approx(1.0).margin(0.003));
  }
}

TEST_CASE("no angle under 31 degrees arises, whatever the points ask for") {
  std::mt19937_64 engine(3);
  std::vector<Vec3> points(4000);
  for (Vec3& p : points) {
    const double radius = 1.0 + uniform(engine, -0.1, 0.1);
    p = radius * testing::direction(engine);
  }
  TriangleMesh mesh = testing::sphere(8);
  const double before = smallest_sine(mesh);
  fit_faces(mesh, points, {.reach = kReach});
  REQUIRE(smallest_sine(mesh) >= std::min(before, 0.515));
}

TEST_CASE("vertices are held as strongly as the wanted median of the angles asks for") {
  std::mt19937_64 engine(8);
  const std::vector<Vec3> points = wavy_points(engine);
  const auto fitted = [&](double median_angle) {
    TriangleMesh mesh = testing::sphere(12);
    fit_faces(mesh, points, {.reach = kReach, .median_angle = median_angle});
    return mesh;
  };
  const TriangleMesh plain = fitted(0.0), enough = fitted(1e-6), better = fitted(1.0);
  CHECK(median_sine(better) > median_sine(plain));
  CHECK(mean_square(better, points) > mean_square(plain, points));  // what it costs
  CHECK(enough == plain);
}

TEST_CASE("the boundary stays where it is") {
  std::mt19937_64 engine(4);
  const std::vector<Vec3> points = testing::sphere_points(0.05, 0.0, engine);
  TriangleMesh mesh = testing::sphere(8);
  testing::cut_where(mesh, [](const Vec3& p) { return p.z > 0.5; });
  const TriangleMesh before = mesh;
  fit_faces(mesh, points, {.reach = kReach});
  REQUIRE(mesh.positions != before.positions);
  const CornerTable table(before.triangles, before.positions.size());
  for (std::uint32_t v = 0; v < before.positions.size(); ++v) {
    if (table.is_boundary(v)) REQUIRE(mesh.positions[v] == before.positions[v]);
  }
}

TEST_CASE("the bits are the same for any number of threads") {
  std::mt19937_64 engine(5);
  const std::vector<Vec3> points = testing::sphere_points(0.05, 0.0, engine);
  std::array<TriangleMesh, 2> meshes{testing::sphere(12), testing::sphere(12)};
  run_with_threads(1, [&] { fit_faces(meshes[0], points, {.reach = kReach}); });
  run_with_threads(4, [&] { fit_faces(meshes[1], points, {.reach = kReach}); });
  REQUIRE(meshes[0] == meshes[1]);
}

TEST_CASE("without points nothing changes") {
  TriangleMesh mesh = testing::sphere(6);
  const TriangleMesh before = mesh;
  fit_faces(mesh, {}, {.reach = kReach});
  REQUIRE(mesh == before);
}

}  // namespace
}  // namespace rangezip
