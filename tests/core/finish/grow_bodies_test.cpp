#include "core/finish/grow_bodies.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "core/mesh/coverage.h"
#include "core/mesh/mesh_report.h"
#include "core/mesh/self_intersection.h"
#include "tests/core/finish/shapes.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

using testing::append;
using testing::direction;
using testing::uniform;

constexpr double kH = 0.05;
constexpr double kSpacing = 0.5 * kH;
const GrowOverOptions kFronts{.pixel_size = kH, .off_mesh = 0.42 * kH};

std::vector<Vec3> ball_points(double radius, const Vec3& center, std::mt19937_64& engine) {
  std::vector<Vec3> points = testing::sphere_points(kSpacing / radius, 0.0, engine);
  for (Vec3& p : points)
    p = center + radius * p;
  return points;
}

/// Whether all faces look away from a place (1), all to it (-1), or some to it and some away (0).
int facing(const TriangleMesh& mesh, std::span<const Triangle> faces, const Vec3& center) {
  std::size_t away = 0;
  for (const Triangle& face : faces) {
    const Vec3 out = centroid_of(mesh.positions, face) - center;
    away += glm::dot(out, unit_normal(mesh.positions, face)) > 0.0 ? 1 : 0;
  }
  if (away == faces.size()) return 1;
  return away == 0 ? -1 : 0;
}

std::span<const Triangle> last(const TriangleMesh& mesh, std::size_t count) {
  return std::span(mesh.triangles).last(count);
}

void require_clean(const TriangleMesh& mesh) {
  REQUIRE(report_mesh(mesh).is_manifold());
  REQUIRE(self_intersections(mesh).empty());
}

void require_unchanged(TriangleMesh mesh, const std::vector<Vec3>& points) {
  const TriangleMesh before = mesh;
  const GrowthReport grown = grow_bodies(mesh, points, {points}, kFronts);
  CHECK(grown.bodies == 0);
  CHECK(grown.faces == 0);
  CHECK(mesh == before);
}

TEST_CASE("the wall of a closed cavity faces into it, and what lies in the cavity faces outwards",
          "[finish]") {
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  const std::vector<Vec3> wall = ball_points(0.7, Vec3(0.0), engine);
  const std::vector<Vec3> core = ball_points(0.4, Vec3(0.0), engine);
  std::vector<Vec3> points = wall;
  points.insert(points.end(), core.begin(), core.end());
  TriangleMesh mesh = testing::sphere(32);
  const std::size_t outside = mesh.triangles.size();

  const GrowthReport grown = grow_bodies(mesh, points, {points}, kFronts);

  REQUIRE(grown.bodies == 2);
  REQUIRE(mesh.triangles.size() == outside + grown.faces);
  require_clean(mesh);
  CHECK(points_off(points, mesh, 0.5 * kH).size() < points.size() / 100);
  std::vector<Triangle> of_wall, of_core;
  for (const Triangle& face : last(mesh, grown.faces)) {
    const bool is_of_wall = glm::length(mesh.positions[face[0]]) > 0.55;
    (is_of_wall ? of_wall : of_core).push_back(face);
  }
  CHECK(facing(mesh, of_wall, Vec3(0.0)) == -1);
  CHECK(facing(mesh, of_core, Vec3(0.0)) == 1);
}

TEST_CASE("a body faces to where its points are seen from, whatever it lies in", "[finish]") {
  const int side = GENERATE(1, -1);
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  CAPTURE(side, seed);
  std::mt19937_64 engine(seed);
  const std::vector<Vec3> points = ball_points(0.5, Vec3(0.0), engine);
  std::vector<std::array<std::int8_t, 3>> votes;
  for (const Vec3& p : points) {
    const Vec3 vote = 100.0 * side * glm::normalize(p);
    votes.push_back({static_cast<std::int8_t>(vote.x), static_cast<std::int8_t>(vote.y),
                     static_cast<std::int8_t>(vote.z)});
  }
  TriangleMesh mesh = testing::sphere(32);
  const GrowthReport grown = grow_bodies(mesh, points, {points, votes}, kFronts);
  REQUIRE(grown.bodies == 1);
  CHECK(facing(mesh, last(mesh, grown.faces), Vec3(0.0)) == side);
}

TEST_CASE("bodies of a few pixels come one by one, turned outwards", "[finish]") {
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  std::vector<Vec3> points;
  for (const double pixels : {4.0, 6.0, 10.0}) {
    const auto ball = ball_points(0.5 * pixels * kH, {1.5, 0.2 * pixels, 0.0}, engine);
    points.insert(points.end(), ball.begin(), ball.end());
  }
  TriangleMesh mesh = testing::sphere(32);
  const GrowthReport grown = grow_bodies(mesh, points, {points}, kFronts);
  REQUIRE(grown.bodies == 3);
  require_clean(mesh);
  for (const double pixels : {4.0, 6.0, 10.0}) {
    const Vec3 center{1.5, 0.2 * pixels, 0.0};
    std::vector<Triangle> faces;
    for (const Triangle& face : last(mesh, grown.faces)) {
      if (glm::length(mesh.positions[face[0]] - center) < 0.6 * pixels * kH) faces.push_back(face);
    }
    CAPTURE(pixels);
    CHECK(faces.size() > 20);
    CHECK(facing(mesh, faces, center) == 1);
  }
}

TEST_CASE(
    "no body comes of stray points, of a sheet, of many points in one place, or of what goes "
    "on from the mesh",
    "[finish]") {
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  const TriangleMesh ball = testing::sphere(32);
  std::vector<Vec3> stray(20'000), sheet(4'000);
  for (Vec3& p : stray)
    p = 0.8 * std::cbrt(uniform(engine, 0.0, 1.0)) * direction(engine);
  require_unchanged(ball, stray);
  for (Vec3& p : sheet)
    p = {uniform(engine, -0.5, 0.5), uniform(engine, -0.5, 0.5), 0.0};
  require_unchanged(ball, sheet);
  std::vector<Vec3> pile(100'000, Vec3(0.0));
  pile.emplace_back(1e30, 0.0, 0.0);
  require_unchanged(ball, pile);
  TriangleMesh open = ball;  // its upper part is left out
  testing::cut_where(open, [](const Vec3& p) { return p.z > -0.7; });
  std::vector<Vec3> rest = testing::sphere_points(kSpacing, 0.0, engine);
  std::erase_if(rest, [](const Vec3& p) { return p.z < -0.7; });
  require_unchanged(open, points_off(rest, open, 0.7 * kH));
}

}  // namespace
}  // namespace rangezip
