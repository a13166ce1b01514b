#include "core/finish/regrow.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "core/finish/left_out_points.h"
#include "core/mesh/mesh_report.h"
#include "core/mesh/self_intersection.h"
#include "tests/core/finish/shapes.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

using testing::append;
using testing::uniform;

constexpr double kH = 1.0;
constexpr int kSide = 24;
const Box kRegion{Vec3(-kSide), Vec3(kSide)};

PointGrid grid_of(const std::vector<Vec3>& points) {
  return PointGrid(points, kRegion, 0.7 * kH);
}

/// About six a pixel in the square of side kSide about the origin, at this height.
void add_sheet_points(std::vector<Vec3>& points, double z, std::mt19937_64& engine) {
  constexpr double kHalf = 0.5 * kSide;
  for (int i = 0; i < 6 * kSide * kSide; ++i)
    points.push_back({uniform(engine, -kHalf, kHalf), uniform(engine, -kHalf, kHalf), z});
}

/// The sheet around this height without its middle; turned over, it looks down.
TriangleMesh frame(double z, double hole, bool is_turned) {
  TriangleMesh mesh = shapes::square_sheet(kSide);
  testing::cut_where(mesh,
                     [&](const Vec3& p) { return std::max(std::abs(p.x), std::abs(p.y)) < hole; });
  for (Vec3& p : mesh.positions)
    p.z = z;
  for (Triangle& t : mesh.triangles) {
    if (is_turned) std::swap(t[1], t[2]);
  }
  remove_unused_vertices(mesh);
  return mesh;
}

void require_clean(const TriangleMesh& mesh) {
  REQUIRE(report_mesh(mesh).is_manifold());
  REQUIRE(self_intersections(mesh).empty());
}

TEST_CASE("regrow covers what scans left out of two sheets two pixels apart, and keeps them apart",
          "[finish]") {
  const double gap = GENERATE(2.0, 3.0);
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  CAPTURE(gap, seed);
  std::mt19937_64 engine(seed);
  std::vector<Vec3> points;
  add_sheet_points(points, 0.0, engine);
  add_sheet_points(points, gap, engine);
  TriangleMesh mesh = frame(0.0, 0.35 * kSide, false);
  append(mesh, frame(gap, 0.35 * kSide, true));
  REQUIRE(left_out_points(points, mesh, kH).size() > points.size() / 4);

  REQUIRE(regrow(mesh, {points}, grid_of(points), {.pixel_size = kH}).faces > 0);

  require_clean(mesh);
  CHECK(left_out_points(points, mesh, kH).empty());
  const auto height = [&](std::uint32_t v) { return mesh.positions[v].z; };
  CHECK(std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
    const double z = height(t[0]) < 0.5 * gap ? 0.0 : gap;
    return std::all_of(t.begin(), t.end(),
                       [&](std::uint32_t v) { return std::abs(height(v) - z) < 1e-3; });
  }));
}

TEST_CASE("nothing grows inside out from a piece whose points are seen from behind it",
          "[finish]") {
  const bool has_votes = GENERATE(true, false);
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  CAPTURE(has_votes, seed);
  std::mt19937_64 engine(seed);
  std::vector<Vec3> points;
  add_sheet_points(points, 0.0, engine);
  TriangleMesh mesh = frame(0.0, 0.35 * kSide, false);
  TriangleMesh piece = shapes::square_sheet(8);
  for (Triangle& t : piece.triangles)
    std::swap(t[1], t[2]);
  append(mesh, piece);
  const std::vector<std::array<std::int8_t, 3>> votes(points.size(), {0, 0, 100});
  SeenPoints seen{.points = points};
  if (has_votes) seen.votes = votes;

  REQUIRE(regrow(mesh, seen, grid_of(points), {.pixel_size = kH}).faces > 0);

  require_clean(mesh);
  CHECK(left_out_points(points, mesh, kH).empty());
  const bool all_look_up =
      std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
        return area_vector(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]).z > 0;
      });
  CHECK(all_look_up == has_votes);  // nothing else tells
}

TEST_CASE("nothing grows inwards on a body, even where nobody has seen the points", "[finish]") {
  const bool is_body = GENERATE(true, false);
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  CAPTURE(is_body, seed);
  std::mt19937_64 engine(seed);
  constexpr double kTop = 0.5 * kSide, kHole = 0.35 * kSide;
  std::vector<Vec3> points;
  add_sheet_points(points, kTop, engine);
  // A cube without the middle of its top, where a scrap lies upside down.
  TriangleMesh mesh = testing::cube(kSide);
  for (Vec3& p : mesh.positions)
    p *= kTop;
  testing::cut_where(mesh, [&](const Vec3& p) {
    return p.z > kTop - 0.1 && std::max(std::abs(p.x), std::abs(p.y)) < kHole;
  });
  remove_unused_vertices(mesh);
  TriangleMesh scrap = shapes::square_sheet(6);
  for (Vec3& p : scrap.positions)
    p.z = kTop;
  for (Triangle& t : scrap.triangles)
    std::swap(t[1], t[2]);
  append(mesh, scrap);

  REQUIRE(regrow(mesh, {points}, grid_of(points), {.pixel_size = kH, .is_body = is_body}).faces >
          0);

  require_clean(mesh);
  double inwards = -36.0;  // the scrap
  for (const Triangle& t : mesh.triangles) {
    if (centroid_of(mesh.positions, t).z > kTop - 0.1 && unit_normal(mesh.positions, t).z < 0.0)
      inwards += area_of_face(mesh.positions, t);
  }
  CHECK((inwards < 10.0) == is_body);
}

TEST_CASE("a front goes down no wall of which the points look out of the back, if it is told so",
          "[finish]") {
  const bool only_outwards = GENERATE(true, false);
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  CAPTURE(only_outwards, seed);
  std::mt19937_64 engine(seed);
  // A sheet that looks up ends at a wall that goes down there: its faces would look to +x.
  TriangleMesh mesh = shapes::square_sheet(kSide);
  testing::cut_where(mesh, [](const Vec3& p) { return p.x > 0.0; });
  std::vector<Vec3> points;
  add_sheet_points(points, 0.0, engine);
  std::erase_if(points, [](const Vec3& p) { return p.x > 0.5; });
  std::vector<std::array<std::int8_t, 3>> votes(points.size(), {0, 0, 100});
  for (int i = 0; i < 6 * kSide * 10; ++i)
    points.push_back(
        {0.5, uniform(engine, -0.5 * kSide, 0.5 * kSide), uniform(engine, -10.0, 0.0)});
  votes.resize(points.size(), {-100, 0, 30});

  regrow(mesh, {points, votes}, grid_of(points),
         {.pixel_size = kH, .only_outwards = only_outwards});

  require_clean(mesh);
  double inside_out = 0.0;
  for (const Triangle& t : mesh.triangles) {
    if (centroid_of(mesh.positions, t).z < -2.0) inside_out += area_of_face(mesh.positions, t);
  }
  if (only_outwards)
    CHECK(inside_out == 0.0);
  else
    CHECK(inside_out > 0.9 * kSide * 8.0);
}

TEST_CASE("regrow over noise of a fifth of a pixel makes faces that are flatter than the noise",
          "[finish]") {
  constexpr double kNoise = 0.2 * kH;
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  std::vector<Vec3> points;
  add_sheet_points(points, 0.0, engine);
  for (Vec3& p : points) {  // of a variance of kNoise^2
    for (int i = 0; i < 12; ++i)
      p.z += kNoise * uniform(engine, -0.5, 0.5);
  }
  constexpr double kHole = 0.35 * kSide;
  TriangleMesh mesh = frame(0.0, kHole, false);
  const std::size_t before = mesh.positions.size();
  REQUIRE(regrow(mesh, {points}, grid_of(points), {.pixel_size = kH}).faces > 100);
  require_clean(mesh);
  double squares = 0.0;
  for (std::size_t v = before; v < mesh.positions.size(); ++v)
    squares += mesh.positions[v].z * mesh.positions[v].z;
  CHECK(squares < 0.35 * kNoise * kNoise * static_cast<double>(mesh.positions.size() - before));
}

TEST_CASE("regrow takes a membrane out of the middle of a gap, with what joins it to the walls",
          "[finish]") {
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  constexpr double kGap = 2.0, kHole = 0.35 * kSide;
  std::vector<Vec3> points;
  add_sheet_points(points, 0.0, engine);
  add_sheet_points(points, kGap, engine);
  // Between the two the membrane, and from the rim of the lower hole to it a strip of faces.
  TriangleMesh mesh = frame(0.0, kHole, false);
  append(mesh, frame(kGap, kHole, true));
  TriangleMesh membrane = shapes::square_sheet(kSide);
  testing::cut_where(membrane,
                     [&](const Vec3& p) { return std::max(std::abs(p.x), std::abs(p.y)) > kHole; });
  for (Vec3& p : membrane.positions)
    p.z = 0.5 * kGap;
  append(mesh, membrane);
  const double rim = std::ceil(kHole);
  const auto vertex_at = [&](const Vec3& place) {
    const auto& p = mesh.positions;
    return static_cast<std::uint32_t>(
        std::find_if(p.begin(), p.end(),
                     [&](const Vec3& q) { return glm::length(q - place) < 1e-9; }) -
        p.begin());
  };
  for (double x = -3.0; x < 3.0; x += 1.0) {
    const std::uint32_t a = vertex_at(Vec3(x, rim, 0.0)), b = vertex_at(Vec3(x + 1.0, rim, 0.0));
    const std::uint32_t c = vertex_at(Vec3(x, rim - 1.0, 0.5 * kGap)),
                        d = vertex_at(Vec3(x + 1.0, rim - 1.0, 0.5 * kGap));
    REQUIRE(std::max({a, b, c, d}) < mesh.positions.size());
    mesh.triangles.push_back({a, c, d});
    mesh.triangles.push_back({a, d, b});
  }
  REQUIRE(report_mesh(mesh).is_manifold());
  REQUIRE(report_mesh(mesh).components == 2);

  REQUIRE(regrow(mesh, {points}, grid_of(points), {.pixel_size = kH}).faces > 0);
  remove_unused_vertices(mesh);

  require_clean(mesh);
  CHECK(report_mesh(mesh).components == 2);
  CHECK(std::none_of(mesh.positions.begin(), mesh.positions.end(),
                     [&](const Vec3& p) { return std::abs(p.z - 0.5 * kGap) < 0.4; }));
  CHECK(left_out_points(points, mesh, 0.5 * kH).empty());
}

TEST_CASE("regrow leaves a hole that holds no points, and what lies far from points left out",
          "[finish]") {
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  std::vector<Vec3> points;
  add_sheet_points(points, 0.0, engine);
  std::erase_if(points, [](const Vec3& p) { return std::max(std::abs(p.x), std::abs(p.y)) < 6.0; });
  TriangleMesh mesh = frame(0.0, 6.0, false);
  const TriangleMesh before = mesh;
  REQUIRE(regrow(mesh, {points}, grid_of(points), {.pixel_size = kH}).faces == 0);
  CHECK(mesh.triangles == before.triangles);
  CHECK(mesh.positions == before.positions);
}

TEST_CASE("regrow makes faces again that are in the way of points, as far around as it is asked to",
          "[finish]") {
  const double in_the_way = GENERATE(0.9, 2.0);
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  CAPTURE(in_the_way, seed);
  std::mt19937_64 engine(seed);
  std::vector<Vec3> points;
  add_sheet_points(points, 0.0, engine);
  TriangleMesh mesh = frame(0.0, 0.35 * kSide, false);
  const TriangleMesh before = mesh;
  double rim = kSide;  // the least distance of a vertex from the middle
  for (const Vec3& p : mesh.positions)
    rim = std::min(rim, std::max(std::abs(p.x), std::abs(p.y)));

  REQUIRE(
      regrow(mesh, {points}, grid_of(points), {.pixel_size = kH, .in_the_way = in_the_way}).faces >
      0);

  require_clean(mesh);
  constexpr double kOffMesh = 0.42, kSpacing = 0.8;  // what the mesh shows; points next to a place
  for (const Triangle& t : before.triangles) {
    double nearest = kSide;
    for (const std::uint32_t v : t) {
      const Vec3& p = before.positions[v];
      nearest = std::min(nearest, std::max(std::abs(p.x), std::abs(p.y)) - rim);
    }
    const bool stays =
        std::find(mesh.triangles.begin(), mesh.triangles.end(), t) != mesh.triangles.end();
    CAPTURE(nearest);
    if (nearest > in_the_way) CHECK(stays);
    if (nearest + kOffMesh + kSpacing < in_the_way) CHECK_FALSE(stays);
  }
}

TEST_CASE(
    "regrow does not take a second layer of points, as scans out of place leave it, for surface",
    "[finish]") {
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  constexpr double kHalf = 0.25 * kSide;
  std::vector<Vec3> points;
  add_sheet_points(points, 0.0, engine);
  for (const double height : {0.5 * kH, kH}) {
    std::vector<Vec3> layer;
    add_sheet_points(layer, height, engine);
    std::erase_if(layer,
                  [&](const Vec3& p) { return std::max(std::abs(p.x), std::abs(p.y)) > kHalf; });
    points.insert(points.end(), layer.begin(), layer.end());
  }
  for (Vec3& p : points)
    p.z += 0.2 * kH * (uniform(engine, -1.0, 1.0) + uniform(engine, -1.0, 1.0));
  TriangleMesh mesh = shapes::square_sheet(kSide);  // in the middle on the top layer
  for (Vec3& p : mesh.positions)
    p.z = std::max(std::abs(p.x), std::abs(p.y)) < kHalf ? kH : 0.0;
  REQUIRE(left_out_points(points, mesh, 0.7 * kH).size() > 40);
  const TriangleMesh before = mesh;
  REQUIRE(regrow(mesh, {points}, grid_of(points), {.pixel_size = kH}).faces == 0);
  CHECK(mesh.triangles == before.triangles);
}

TEST_CASE("regrow leaves points alone that lie far from any face", "[finish]") {
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  std::vector<Vec3> points;
  add_sheet_points(points, 0.4 * kSide, engine);
  TriangleMesh mesh = frame(0.0, 2.0, false);
  append(mesh, frame(0.8 * kSide, 2.0, true));
  const TriangleMesh before = mesh;
  REQUIRE(regrow(mesh, {points}, grid_of(points), {.pixel_size = kH}).faces == 0);
  CHECK(mesh.triangles == before.triangles);
}

}  // namespace
}  // namespace rangezip
