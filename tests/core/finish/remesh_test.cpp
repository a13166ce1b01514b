#include "core/finish/remesh.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "core/base/parallel.h"
#include "core/finish/triangle_shape.h"
#include "core/mesh/mesh_report.h"
#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

TEST_CASE("sine_of_smallest_angle is that of the smallest angle") {
  REQUIRE(sine_of_smallest_angle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}) == Approx(std::sqrt(0.5)));
  REQUIRE(sine_of_smallest_angle({0, 0, 0}, {2, 0, 0}, {1, std::sqrt(3.0), 0}) ==
          Approx(std::sqrt(0.75)));
  REQUIRE(sine_of_smallest_angle({0, 0, 0}, {1, 0, 0}, {2, 0, 0}) == 0.0);
  REQUIRE(sine_of_smallest_angle({1, 1, 1}, {1, 1, 1}, {1, 1, 1}) == 0.0);
}

/// A sphere whose vertices are pushed about along it and off it, and points of it.
struct RoughSphere {
  TriangleMesh mesh;
  std::vector<Vec3> points;
  double h = 0.0;

  [[nodiscard]] PointGrid cloud() const { return {points, Box{Vec3(-1.5), Vec3(1.5)}, 0.7 * h}; }
  [[nodiscard]] RemeshOptions options(std::size_t triangles = 0) const {
    return {.pixel_size = h, .fit = {{1.3 * h, h}, 0.0, {}}, .triangles = triangles};
  }
};

RoughSphere rough_sphere(int n, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  RoughSphere rough{testing::sphere(n), {}, 1.6 / n};
  for (Vec3& p : rough.mesh.positions) {
    p = glm::normalize(p + 0.25 * rough.h * testing::direction(engine));
    p *= 1.0 + testing::uniform(engine, -0.1, 0.1) * rough.h;
  }
  rough.points = testing::sphere_points(rough.h / 2.2, 0.0, engine);
  return rough;
}

TEST_CASE("remesh brings a rough sphere back onto the sphere with better triangles") {
  const std::uint64_t seed = GENERATE(1U, 2U, 3U);
  CAPTURE(seed);
  RoughSphere rough = rough_sphere(24, seed);
  const PointGrid cloud = rough.cloud();
  const RemeshReport report = remesh(rough.mesh, cloud, cloud, rough.options());
  remove_unused_vertices(rough.mesh);
  REQUIRE(report.flipped_edges > 0);
  REQUIRE(testing::smallest_angle(rough.mesh) > 0.5);  // 29 degrees
  REQUIRE(report_mesh(rough.mesh).is_manifold());
  REQUIRE(report_mesh(rough.mesh).euler == 2);
  // Over a disc of radius r a sphere's height is r^2 / 2 + r^4 / 8 and more: what no quadric
  // follows is at most the last part, for the radius of the fit; where points are few, a plane
  // misses both.
  const double fourth = std::pow(1.3 * rough.h, 4.0) / 8.0;
  double mean = 0.0;
  for (const Vec3& p : rough.mesh.positions) {
    REQUIRE(std::abs(glm::length(p) - 1.0) < 0.5 * 1.69 * rough.h * rough.h);
    mean += std::abs(glm::length(p) - 1.0) / static_cast<double>(rough.mesh.positions.size());
  }
  REQUIRE(mean < fourth);
}

TEST_CASE("remesh makes triangles as much smaller as their sizes say, and no others") {
  RoughSphere rough = rough_sphere(24, 5);
  const std::size_t before = rough.mesh.triangles.size();
  // Half the size where z > 0.45, which is where the next cubes are these.
  RemeshOptions options = rough.options();
  options.sizes =
      ShareField(0.9, {{-1, -1, 1}, {-1, 0, 1}, {0, -1, 1}, {0, 0, 1}}, {0.5, 0.5, 0.5, 0.5});
  const PointGrid cloud = rough.cloud();
  remesh(rough.mesh, cloud, cloud, options);
  double small = 0.0, plain = 0.0;
  int smalls = 0, plains = 0;
  for (const Triangle& t : rough.mesh.triangles) {
    const Vec3 &a = rough.mesh.positions[t[0]], &b = rough.mesh.positions[t[1]];
    if (a.z > 0.7) small += glm::distance(a, b), ++smalls;
    if (a.z < 0.0) plain += glm::distance(a, b), ++plains;
  }
  REQUIRE(small / smalls == Approx(0.5 * plain / plains).epsilon(0.1));
  REQUIRE(plains == Approx(0.5 * static_cast<double>(before)).epsilon(0.1));
}

TEST_CASE("remesh meets a number of triangles") {
  RoughSphere rough = rough_sphere(24, 4);
  const std::size_t before = rough.mesh.triangles.size();
  const double share = GENERATE(0.1, 0.5, 2.0, 5.0);
  CAPTURE(share);
  const auto wanted = static_cast<std::size_t>(share * static_cast<double>(before));
  const PointGrid cloud = rough.cloud();
  remesh(rough.mesh, cloud, cloud, rough.options(wanted));
  const auto got = static_cast<double>(rough.mesh.triangles.size());
  REQUIRE(got == Approx(static_cast<double>(wanted)).epsilon(0.05));
  REQUIRE(report_mesh(rough.mesh).euler == 2);
}

TEST_CASE("remesh raises no vertex farther over the edges of a cube") {
  const std::uint64_t seed = GENERATE(range(1U, 21U));
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  constexpr int kN = 20;
  constexpr double kPixel = 2.0 / kN;
  TriangleMesh mesh = testing::cube(kN);
  for (Vec3& p : mesh.positions) {  // edges as scans cut them off, with vertices in the air
    const Vec3 core = glm::clamp(p, Vec3(0.6 * kPixel - 1.0), Vec3(1.0 - 0.6 * kPixel));
    const double radius = testing::uniform(engine, 0.0, 1.0) < 0.1 ? 1.4 : 0.6;
    const double shift = testing::uniform(engine, 0.0, 0.3 * kPixel);
    p = core + radius * kPixel * glm::normalize(p - core) + shift * testing::direction(engine);
  }
  std::vector<Vec3> points(static_cast<std::size_t>(24.0 * std::pow(2.2 / kPixel, 2.0)));
  for (Vec3& p : points) {
    p = {testing::uniform(engine, -1, 1), testing::uniform(engine, -1, 1),
         testing::uniform(engine, -1, 1)};
    p[static_cast<int>(engine() % 3)] = engine() % 2 == 0 ? 1.0 : -1.0;
  }
  const PointGrid cloud(points, Box{Vec3(-1.5), Vec3(1.5)}, 0.7 * kPixel);
  remesh(mesh, cloud, cloud, {.pixel_size = kPixel, .fit = {{1.3 * kPixel, kPixel}, 0.0, {}}});
  remove_unused_vertices(mesh);
  for (const Vec3& p : mesh.positions) {
    const Vec3 q = glm::abs(p);
    REQUIRE(std::max({q.x, q.y, q.z}) < 1.0 + 0.7 * kPixel);
  }
}

TEST_CASE("remesh keeps the boundary and does nothing to the topology") {
  RoughSphere rough = rough_sphere(20, 4);
  testing::cut_where(rough.mesh, [](const Vec3& p) { return p.z > 0.5; });
  const MeshReport before = report_mesh(rough.mesh);
  const PointGrid cloud = rough.cloud();
  remesh(rough.mesh, cloud, cloud, rough.options());
  const MeshReport after = report_mesh(rough.mesh);
  REQUIRE(after.boundary_edges == before.boundary_edges);
  REQUIRE(after.longest_loop == before.longest_loop);
  REQUIRE(after.euler == before.euler);
  REQUIRE(after.is_manifold());
}

TEST_CASE("remesh gives the same mesh for any number of threads") {
  const RoughSphere rough = rough_sphere(24, 5);
  const PointGrid cloud = rough.cloud();
  TriangleMesh one = rough.mesh, two = rough.mesh;
  run_with_threads(1, [&] { remesh(one, cloud, cloud, rough.options()); });
  run_with_threads(2, [&] { remesh(two, cloud, cloud, rough.options()); });
  REQUIRE(one == two);
}

TEST_CASE("without a cloud remesh evens out triangles within the surface") {
  RoughSphere rough = rough_sphere(16, 5);
  const double angle_before = testing::smallest_angle(rough.mesh);
  const PointGrid none({}, bounds_of(rough.mesh), 0.1);
  remesh(rough.mesh, none, none, rough.options());
  remove_unused_vertices(rough.mesh);
  REQUIRE(testing::smallest_angle(rough.mesh) > angle_before);
  // Middles of edges lie below the sphere by h^2 / 8, and vertices that move by as much again.
  for (const Vec3& p : rough.mesh.positions)
    REQUIRE(std::abs(glm::length(p) - 1.0) < rough.h * rough.h + 0.1 * rough.h);
}

}  // namespace
}  // namespace rangezip
