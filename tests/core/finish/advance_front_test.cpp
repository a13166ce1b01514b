#include "core/finish/advance_front.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "core/finish/clean_topology.h"
#include "core/finish/votes_near.h"
#include "core/mesh/coverage.h"
#include "core/mesh/mesh_report.h"
#include "core/mesh/self_intersection.h"
#include "tests/core/finish/shapes.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

using testing::uniform;

constexpr double kH = 1.0;

double length_between(const TriangleMesh& mesh, std::uint32_t a, std::uint32_t b) {
  return glm::length(mesh.positions[a] - mesh.positions[b]);
}

double area_of(const TriangleMesh& mesh) {
  double area = 0.0;
  for (const auto& [a, b, c] : mesh.triangles)
    area += 0.5 * glm::length(area_vector(mesh.positions[a], mesh.positions[b], mesh.positions[c]));
  return area;
}

/// A square sheet of side 24 in z = 0 without the squares where a place is to be left out.
template <class IsLeftOut>
TriangleMesh sheet_without(IsLeftOut is_left_out) {
  TriangleMesh mesh = shapes::square_sheet(24);
  testing::cut_where(mesh, is_left_out);
  return mesh;
}

/// So many points a square in a box.
std::vector<Vec3> points_in(const Box& box, double per_square, std::mt19937_64& engine) {
  const Vec3 size = box.upper - box.lower;
  const double area =
      std::max({size.x * size.y, size.y * size.z, size.z * size.x});  // the box is flat
  std::vector<Vec3> points;
  for (double i = 0.0; i < per_square * area; i += 1.0) {
    points.push_back({uniform(engine, box.lower.x, box.upper.x),
                      uniform(engine, box.lower.y, box.upper.y),
                      uniform(engine, box.lower.z, box.upper.z)});
  }
  return points;
}

TEST_CASE("fronts from all sides of a hole cover 98 % of it with points and meet as one sheet",
          "[finish]") {
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  constexpr double kHole = 16.0;  // side, up to the nearest squares that are left
  TriangleMesh mesh =
      sheet_without([](const Vec3& p) { return std::max(std::abs(p.x), std::abs(p.y)) < 7.5; });
  const std::vector<Triangle> before = mesh.triangles;
  const auto points = points_in({Vec3(-7.8, -7.8, 0.0), Vec3(7.8, 7.8, 0.0)}, 6.0, engine);

  const std::size_t came = advance_front(mesh, points, {.pixel_size = kH});

  REQUIRE(mesh.triangles.size() == before.size() + came);
  CHECK(std::equal(before.begin(), before.end(), mesh.triangles.begin()));
  CHECK(self_intersections(mesh).empty());
  clean_topology(mesh);
  CHECK(mesh.triangles.size() == before.size() + came);
  remove_unused_vertices(mesh);
  const MeshReport report = report_mesh(mesh);
  CHECK(report.is_manifold());
  CHECK(report.components == 1);
  CHECK(area_of(mesh) <= 24.0 * 24.0 * (1.0 + 1e-9));
  CHECK(area_of(mesh) >= 24.0 * 24.0 - 0.02 * kHole * kHole);
  CHECK(std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
    return area_vector(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]).z > 0.0;
  }));
}

TEST_CASE("no face of a front is larger than its circle, nor has new points nearer than apart",
          "[finish]") {
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  const double apart = GENERATE(0.6, 0.3);
  TriangleMesh mesh = sheet_without([](const Vec3& p) { return p.x > -8.5; });
  const std::size_t faces = mesh.triangles.size(), vertices = mesh.positions.size();
  const auto points = points_in({Vec3(-8.0, -12.0, -0.1), Vec3(12.0, 12.0, 0.1)}, 2.0, engine);
  REQUIRE(advance_front(mesh, points, {.pixel_size = kH, .apart = apart}) > 100);
  for (std::size_t f = faces; f < mesh.triangles.size(); ++f) {
    const auto& [a, b, c] = mesh.triangles[f];
    const double sides =
        length_between(mesh, a, b) * length_between(mesh, b, c) * length_between(mesh, c, a);
    const double area =
        glm::length(area_vector(mesh.positions[a], mesh.positions[b], mesh.positions[c]));
    CHECK(sides / (2.0 * area) <= 0.9 * kH + 1e-12);
  }
  for (std::size_t i = vertices; i < mesh.positions.size(); ++i) {
    for (std::size_t k = vertices; k < i; ++k)
      REQUIRE(glm::length(mesh.positions[i] - mesh.positions[k]) >= apart * kH);
  }
}

TEST_CASE("a front does not cross a gap of two pixels that holds no points", "[finish]") {
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  // A row of squares is gone on either side of the gap between x = -1 and 1, and has points.
  TriangleMesh mesh = sheet_without([](const Vec3& p) { return std::abs(p.x) < 1.5; });
  auto points = points_in({Vec3(-2.0, -12.0, 0.0), Vec3(-1.0, 12.0, 0.0)}, 6.0, engine);
  const auto others = points_in({Vec3(1.0, -12.0, 0.0), Vec3(2.0, 12.0, 0.0)}, 6.0, engine);
  points.insert(points.end(), others.begin(), others.end());
  REQUIRE(advance_front(mesh, points, {.pixel_size = kH}) > 20);
  clean_topology(mesh);
  CHECK(report_mesh(mesh).components == 2);
}

TEST_CASE("a front goes around a crease, up the wall behind it", "[finish]") {
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  const double side = GENERATE(-1.0, 1.0);  // a wall that goes down, and one that goes up
  CAPTURE(seed, side);
  std::mt19937_64 engine(seed);
  TriangleMesh mesh = sheet_without([](const Vec3& p) { return p.x > 0.5; });
  auto points = points_in({Vec3(0.1, -12.0, 0.0), Vec3(0.6, 12.0, 0.0)}, 6.0, engine);
  const auto wall = side > 0.0 ? Box{Vec3(0.6, -12.0, 0.0), Vec3(0.6, 12.0, 10.0)}
                               : Box{Vec3(0.6, -12.0, -10.0), Vec3(0.6, 12.0, 0.0)};
  const auto on_wall = points_in(wall, 6.0, engine);
  points.insert(points.end(), on_wall.begin(), on_wall.end());
  REQUIRE(advance_front(mesh, points, {.pixel_size = kH}) > 100);
  clean_topology(mesh);
  const auto covered = covered_points(on_wall, mesh, 0.6 * kH);
  const auto left = static_cast<std::size_t>(std::count(covered.begin(), covered.end(), 0));
  CHECK(left < on_wall.size() / 100);
  REQUIRE(self_intersections(mesh).empty());
  // What looked up looks away from the inside of the bend.
  double facing = 0.0, area = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 normal = area_vector(mesh.positions[a], mesh.positions[b], mesh.positions[c]);
    if (std::abs(mesh.positions[a].z) < 1.0) continue;
    facing += -side * normal.x;
    area += glm::length(normal);
  }
  CHECK(facing > 0.95 * area);
}

TEST_CASE("a front makes no face of which the points around look out of the back", "[finish]") {
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  const int side = GENERATE(-1, 1);  // to which the points of the wall below the sheet look
  CAPTURE(seed, side);
  std::mt19937_64 engine(seed);
  TriangleMesh mesh = sheet_without([](const Vec3& p) { return p.x > 0.5; });
  auto points = points_in({Vec3(0.1, -12.0, 0.0), Vec3(0.6, 12.0, 0.0)}, 6.0, engine);
  std::vector<std::array<std::int8_t, 3>> votes(points.size(), {0, 0, 127});
  const auto wall = points_in({Vec3(0.6, -12.0, -10.0), Vec3(0.6, 12.0, 0.0)}, 6.0, engine);
  points.insert(points.end(), wall.begin(), wall.end());
  votes.resize(points.size(), {static_cast<std::int8_t>(100 * side), 0, 30});
  const VoteGrid grid({points, votes}, points, 0.75 * kH);

  advance_front(mesh, points, {.pixel_size = kH, .votes = &grid});

  const auto covered = covered_points(wall, mesh, 0.6 * kH);
  const auto on_mesh = static_cast<std::size_t>(std::count(covered.begin(), covered.end(), 1));
  // The sheet looks up, so its wall looks to +x; of another only the rim lies on the sheet.
  if (side > 0)
    CHECK(on_mesh > wall.size() / 100 * 98);
  else
    CHECK(on_mesh < wall.size() / 5);
}

TEST_CASE("a front does not cross what is in the way", "[finish]") {
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  TriangleMesh mesh = sheet_without([](const Vec3& p) { return p.x > -2.5; });
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(),
                        {{3.0, -20.0, -9.0}, {3.0, 20.0, -9.0}, {3.0, 0, 30.0}});
  mesh.triangles.push_back({first, first + 1, first + 2});
  const auto points = points_in({Vec3(-3.0, -12.0, 0.0), Vec3(12.0, 12.0, 0.0)}, 6.0, engine);
  REQUIRE(advance_front(mesh, points, {.pixel_size = kH}) > 100);
  CHECK(self_intersections(mesh).empty());
}

TEST_CASE("fronts are joined over a place without points as wide as their circle, and only there",
          "[finish]") {
  // Two holes of the six triangles around a vertex: of the hexagon two corners are small triangles,
  // the rest is a square whose circle has a radius of 1.
  const Vec3 here(-5.0, 0.0, 0.0), there(5.0, 0.0, 0.0);
  const auto sheet = [&] {
    return sheet_without([&](const Vec3& p) {
      return std::min(glm::length(p - here), glm::length(p - there)) < 0.5;
    });
  };
  TriangleMesh narrow = sheet(), wide = sheet();
  REQUIRE(area_of(narrow) == Approx(24.0 * 24.0 - 2.0 * 3.0));
  const std::vector<Vec3> places(1, here);
  close_fronts(narrow, places, {.pixel_size = kH, .max_radius = 0.9});
  close_fronts(wide, places, {.pixel_size = kH, .max_radius = 1.05});
  CHECK(area_of(narrow) == Approx(24.0 * 24.0 - 3.0 - 2.0));
  CHECK(area_of(wide) == Approx(24.0 * 24.0 - 3.0));
  CHECK(self_intersections(wide).empty());
  CHECK(report_mesh(wide).is_manifold());
  CHECK(report_mesh(wide).boundary_loops == 2);  // the sheet's and the other hole's
}

TEST_CASE("fronts are not joined across a gap of two and a half pixels", "[finish]") {
  TriangleMesh mesh = sheet_without([](const Vec3& p) { return std::abs(p.x) < 0.9; });
  for (Vec3& p : mesh.positions)
    p.x *= 1.25;  // the gap was two squares wide
  const TriangleMesh before = mesh;
  std::vector<Vec3> along;
  for (double y = -12.0; y <= 12.0; y += 1.0)
    along.emplace_back(0.0, y, 0.0);
  CHECK(close_fronts(mesh, along, {.pixel_size = kH, .max_radius = 1.15}) == 0);
  CHECK(mesh == before);
}

TEST_CASE("a front without points or without a border does nothing", "[finish]") {
  TriangleMesh sheet = shapes::square_sheet(4), closed = testing::cube(4);
  CHECK(advance_front(sheet, {}, {.pixel_size = kH}) == 0);
  CHECK(advance_front(closed, std::vector<Vec3>(3, Vec3(1.5, 0.0, 0.0)), {.pixel_size = kH}) == 0);
  CHECK(closed.triangles == testing::cube(4).triangles);
  CHECK(close_fronts(sheet, {}, {.pixel_size = kH}) == 0);
}

}  // namespace
}  // namespace rangezip
