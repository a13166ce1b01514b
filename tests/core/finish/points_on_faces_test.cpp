#include "core/finish/points_on_faces.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>
#include <random>

#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

using testing::uniform;

double distance_to(const TriangleMesh& mesh, std::uint32_t face, const Vec3& p) {
  const Triangle& t = mesh.triangles[face];
  return glm::length(closest_point_on_triangle(p, mesh.positions[t[0]], mesh.positions[t[1]],
                                               mesh.positions[t[2]]) -
                     p);
}

double distance_to(const TriangleMesh& mesh, const Vec3& p) {
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f)
    least = std::min(least, distance_to(mesh, f, p));
  return least;
}

/// Points that belong to a face, each to one not farther than the nearest one but for `slack`.
std::size_t count_and_check(const PointsOnFaces& points, const TriangleMesh& mesh, double slack) {
  std::size_t count = 0;
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    for (const std::uint32_t i : points.of_face(f)) {
      REQUIRE(distance_to(mesh, f, points.point(i)) <= distance_to(mesh, points.point(i)) + slack);
      ++count;
    }
  }
  return count;
}

TEST_CASE("a point over a ridge, as near to both sides, stays with its face whatever is rounded") {
  const std::uint64_t seed = GENERATE(1U, 2U, 3U);
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  const TriangleMesh roof{
      {{0, 0, 0}, {1, 0.1, 0.05}, {0.5, 1, -0.2}, {0.6, -1, -0.3}}, {{0, 1, 2}, {1, 0, 3}}, {}};
  const CornerTable table(roof.triangles, roof.positions.size());
  for (int i = 0; i < 100; ++i) {
    const double along = uniform(engine, 0.1, 0.9);
    const Vec3 point = along * roof.positions[1] + Vec3(0.0, 0.0, uniform(engine, 0.01, 0.1));
    PointsOnFaces on_faces(roof, table, {point}, 0.5);
    const std::size_t of_first = on_faces.of_face(0).size();
    for (int step = 0; step < 20; ++step) {
      std::vector<Vec3> rounded = roof.positions;
      for (Vec3& p : rounded)
        p += 1e-13 * Vec3{uniform(engine, -1, 1), uniform(engine, -1, 1), uniform(engine, -1, 1)};
      on_faces.follow(table, rounded);
      REQUIRE(on_faces.of_face(0).size() == of_first);
    }
  }
}

TEST_CASE("points belong to the nearest face within reach and follow it when vertices move") {
  constexpr double kReach = 0.15;
  std::mt19937_64 engine(1);
  TriangleMesh mesh = testing::sphere(6);
  std::vector<Vec3> points;
  std::size_t within = 0;
  for (int i = 0; i < 800; ++i) {
    const Vec3 direction{uniform(engine, -1, 1), uniform(engine, -1, 1), uniform(engine, -1, 1)};
    points.push_back(uniform(engine, 0.8, 1.3) * glm::normalize(direction));
    within += distance_to(mesh, points.back()) < kReach ? 1 : 0;
  }
  const CornerTable table(mesh.triangles, mesh.positions.size());
  PointsOnFaces on_faces(mesh, table, points, kReach);
  REQUIRE(within > 100);
  REQUIRE(within < points.size());
  REQUIRE(count_and_check(on_faces, mesh, 1e-12) == within);

  constexpr double kMove = 0.02;
  for (Vec3& p : mesh.positions)
    p += kMove * Vec3{uniform(engine, -1, 1), uniform(engine, -1, 1), uniform(engine, -1, 1)};
  on_faces.follow(table, mesh.positions);
  REQUIRE(count_and_check(on_faces, mesh, kMove) == within);
}

TEST_CASE("after some faces have changed the points are found as if anew") {
  const std::uint64_t seed = GENERATE(1U, 2U, 3U, 4U);
  CAPTURE(seed);
  constexpr double kReach = 0.15;
  std::mt19937_64 engine(seed);
  TriangleMesh mesh = testing::sphere(8);
  std::vector<Vec3> points;
  for (int i = 0; i < 4000; ++i) {
    const Vec3 direction{uniform(engine, -1, 1), uniform(engine, -1, 1), uniform(engine, -1, 1)};
    points.push_back(uniform(engine, 0.8, 1.3) * glm::normalize(direction));
  }
  CornerTable table(mesh.triangles, mesh.positions.size());
  PointsOnFaces on_faces(mesh, table, points, kReach);
  for (int round = 0; round < 5; ++round) {
    const TriangleMesh before = mesh;
    for (int i = 0; i < 5; ++i) {
      Vec3& p = mesh.positions[engine() % mesh.positions.size()];
      p *= uniform(engine, 0.8, 1.2);
      table.split_edge(static_cast<std::uint32_t>(engine() % table.corner_count()));
      mesh.positions.push_back(glm::normalize(
          Vec3{uniform(engine, -1, 1), uniform(engine, -1, 1), uniform(engine, -1, 1)}));
    }
    mesh.triangles = table.triangles();
    std::vector<std::uint8_t> is_changed(mesh.triangles.size(), 1);
    for (std::size_t f = 0; f < before.triangles.size(); ++f) {
      const Triangle& t = mesh.triangles[f];
      const bool is_same = t == before.triangles[f] && std::all_of(t.begin(), t.end(), [&](auto v) {
                             return mesh.positions[v] == before.positions[v];
                           });
      is_changed[f] = is_same ? 0 : 1;
    }
    on_faces.find_again(mesh, table, is_changed);
    const PointsOnFaces anew(mesh, table, points, kReach);
    for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
      const auto found = on_faces.of_face(f), expected = anew.of_face(f);
      REQUIRE(std::equal(found.begin(), found.end(), expected.begin(), expected.end()));
    }
  }
}

TEST_CASE("barycentric coordinates of a foot are those of the place in the plane") {
  const Vec3 a(1, 0, 0), b(0, 2, 0), c(0, 0, 3);
  const Vec3 normal = glm::normalize(glm::cross(b - a, c - a));
  const auto share = barycentric(0.2 * a + 0.3 * b + 0.5 * c + 0.7 * normal, a, b, c);
  REQUIRE(share[0] == Approx(0.2));
  REQUIRE(share[1] == Approx(0.3));
  REQUIRE(share[2] == Approx(0.5));
}

}  // namespace
}  // namespace rangezip
