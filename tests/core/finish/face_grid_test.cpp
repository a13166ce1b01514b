#include "core/finish/face_grid.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

using testing::uniform;

/// By looking at every face.
double distance_to(const TriangleMesh& mesh, const Vec3& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Triangle& t : mesh.triangles) {
    const Vec3 nearest = closest_point_on_triangle(p, mesh.positions[t[0]], mesh.positions[t[1]],
                                                   mesh.positions[t[2]]);
    least = std::min(least, glm::length(nearest - p));
  }
  return least;
}

TEST_CASE("FaceGrid finds a face nearer than a distance just where there is one") {
  const std::uint64_t seed = GENERATE(1U, 2U, 3U);
  CAPTURE(seed);
  TriangleMesh mesh = testing::sphere(8);
  testing::cut_where(mesh, [](const Vec3& p) { return p.z > 0.3; });
  const CornerTable table(mesh.triangles, mesh.positions.size());
  constexpr double kReach = 0.2;
  const FaceGrid grid(mesh, table, kReach);
  std::mt19937_64 engine(seed);
  int inside = 0, outside = 0;
  for (int i = 0; i < 500; ++i) {
    // Within the reach of the border, which runs around at some z up to 0.3.
    const Vec3& corner = mesh.positions[static_cast<std::size_t>(
        uniform(engine, 0.0, static_cast<double>(mesh.positions.size())))];
    if (!table.is_boundary(static_cast<std::uint32_t>(&corner - mesh.positions.data()))) continue;
    const Vec3 p = corner + Vec3{uniform(engine, -0.1, 0.1), uniform(engine, -0.1, 0.1),
                                 uniform(engine, -0.1, 0.1)};
    const double distance = distance_to(mesh, p);
    if (distance > 0.9 * kReach) continue;
    REQUIRE(grid.has_face_within(p, 1.001 * distance + 1e-12));
    REQUIRE_FALSE(grid.has_face_within(p, 0.999 * distance));
    // Whatever is guessed, a face that is found is near enough, and one is found if there is one.
    const auto guess = static_cast<std::uint32_t>(engine() % mesh.triangles.size());
    const std::uint32_t face = grid.face_within(p, 1.001 * distance + 1e-12, guess);
    REQUIRE(face != CornerTable::kNone);
    const Triangle& t = mesh.triangles[face];
    REQUIRE(squared_distance_to_triangle(p, mesh.positions[t[0]], mesh.positions[t[1]],
                                         mesh.positions[t[2]]) <=
            std::pow(1.001 * distance + 1e-12, 2.0));
    REQUIRE(grid.face_within(p, 0.999 * distance, guess) == CornerTable::kNone);
    ++(distance > 0.01 ? outside : inside);
  }
  REQUIRE(inside + outside > 20);
  REQUIRE(outside > 5);
}

TEST_CASE("FaceGrid of a closed mesh holds no face") {
  const TriangleMesh mesh = testing::cube(4);
  const CornerTable table(mesh.triangles, mesh.positions.size());
  const FaceGrid grid(mesh, table, 0.5);
  REQUIRE_FALSE(grid.has_face_within({1.0, 0.0, 0.0}, 0.5));
}

TEST_CASE("FaceGrid finds the nearest face of all, near or far, and none beyond the distance") {
  const std::uint64_t seed = GENERATE(1U, 2U, 3U);
  CAPTURE(seed);
  const TriangleMesh mesh = testing::sphere(8);
  const FaceGrid grid(mesh, 0.3);
  std::mt19937_64 engine(seed);
  for (int i = 0; i < 300; ++i) {
    const double x = uniform(engine, -1.5, 1.5), y = uniform(engine, -1.5, 1.5);
    const Vec3 p{x, y, uniform(engine, -1.5, 1.5)};
    const double distance = distance_to(mesh, p);
    const std::uint32_t face = grid.nearest_face(p, 1.001 * distance + 1e-12);
    REQUIRE(face != CornerTable::kNone);
    const Triangle& t = mesh.triangles[face];
    const Vec3 foot = closest_point_on_triangle(p, mesh.positions[t[0]], mesh.positions[t[1]],
                                                mesh.positions[t[2]]);
    REQUIRE(glm::length(foot - p) == Approx(distance));
    REQUIRE(grid.nearest_face(p, 3.0) == face);
    const auto guess = static_cast<std::uint32_t>(
        uniform(engine, 0.0, static_cast<double>(mesh.triangles.size())));
    REQUIRE(grid.nearest_face(p, 3.0, guess) == face);
    REQUIRE(grid.nearest_face(p, 0.999 * distance, guess) == CornerTable::kNone);
    REQUIRE(grid.nearest_face(p, 0.999 * distance) == CornerTable::kNone);
  }
}

}  // namespace
}  // namespace rangezip
