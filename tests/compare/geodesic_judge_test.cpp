#include "compare/geodesic_judge.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "compare/mesh_distance.h"
#include "core/base/error.h"
#include "tests/compare/cubes.h"
#include "tests/core/stitch/hand_scans.h"

using namespace rangezip;
using namespace rangezip::compare;

namespace {

const View kView = images::parallel_view(test::kExtent);

std::uint32_t face_below(const TriangleMesh& mesh, Pixel pixel) {
  const Vec3 point = test::world(pixel.x, pixel.y, 20.0);
  const auto found =
      nearest_faces_along(std::vector<Vec3>{point}, std::vector<Vec3>{{0, 0, 1}}, mesh);
  REQUIRE(found[0]);
  return found[0]->face;
}

std::optional<SurfacePath> line_over(const TriangleMesh& mesh, Pixel from, Pixel to) {
  const ViewedMesh seen(mesh, kView);
  return follow_line(seen, {from, face_below(mesh, from)}, {to, face_below(mesh, to)});
}

GeodesicMatch match(const TriangleMesh& mesh, const SurfacePath& path) {
  return judge_geodesics(mesh, {&path, 1}).front();
}

/// A level triangle left of x = 32 in the image, and one that falls off with `slope` right of it.
TriangleMesh roof(double slope) {
  TriangleMesh mesh;
  mesh.positions = {test::world(32, 20, 20.0), test::world(32, 44, 20.0), test::world(8, 32, 20.0),
                    test::world(56, 32, 20.0 + 24.0 * slope)};
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}};
  return mesh;
}

}  // namespace

TEST_CASE("on a plane the straight line in the image is the shortest path") {
  const TriangleMesh mesh = test::lattice({8.2, 8.3}, 40, 40, 1.0, 20.0);
  for (const Pixel to :
       {Pixel{21, 20}, Pixel{21, 21}, Pixel{19, 20}, Pixel{31, 23}, Pixel{20, 9}}) {
    CAPTURE(to.x, to.y);
    const auto path = line_over(mesh, {20, 20}, to);
    REQUIRE(path);
    const double distance = std::hypot(to.x - 20, to.y - 20);
    const GeodesicMatch found = match(mesh, *path);
    REQUIRE(found.is_judged);
    CHECK(found.line == Approx(distance).epsilon(1e-9));
    CHECK(found.length == Approx(distance).epsilon(1e-9));
    CHECK(found.shortest == Approx(distance).epsilon(1e-9));
    CHECK(found.deviation < 1e-6);
  }
}

TEST_CASE("lines along edges and through vertices arrive") {
  const TriangleMesh mesh = test::lattice({10.0, 10.0}, 20, 20, 1.0, 20.0);
  for (const Pixel to : {Pixel{25, 20}, Pixel{20, 14}, Pixel{26, 26}, Pixel{13, 27}}) {
    CAPTURE(to.x, to.y);
    const auto path = line_over(mesh, {20, 20}, to);
    REQUIRE(path);
    CHECK(length_of(path->points) == Approx(std::hypot(to.x - 20, to.y - 20)).epsilon(1e-9));
    CHECK(match(mesh, *path).shortest == Approx(length_of(path->points)).epsilon(1e-9));
  }
}

TEST_CASE("over a roof the shortest path is the straight line of the unfolded roof") {
  const Pixel from{28, 30};  // 4 before the ridge
  const Pixel to{34, 36};    // 2 behind it, 6 along it
  for (const double slope : {0.5, 2.0, 4.0}) {
    CAPTURE(slope);
    const TriangleMesh mesh = roof(slope);
    const auto path = line_over(mesh, from, to);
    REQUIRE(path);
    const double down = 2.0 * std::sqrt(1.0 + slope * slope);
    // In the image the line meets the ridge after 4 / 6 of the way.
    const double line = std::hypot(4.0, 4.0) + std::hypot(down, 2.0);
    const double unfolded = std::hypot(4.0 + down, 6.0);
    const GeodesicMatch found = match(mesh, *path);
    REQUIRE(found.is_judged);
    CHECK(found.line == Approx(line).epsilon(1e-9));
    CHECK(found.shortest == Approx(unfolded).epsilon(1e-9));
    CHECK(found.length == Approx(unfolded).epsilon(1e-9));  // both faces are the right ones
    CHECK(found.line > found.shortest);
  }
}

TEST_CASE("on a fine sphere the shortest path is as long as the arc of its great circle") {
  const double radius = 10.0;
  TriangleMesh mesh = shapes::to_mesh(shapes::sphere(radius, 96));
  for (Vec3& p : mesh.positions)
    p += Vec3{0.5, 0.5, -32.0};  // the middle of pixel (32, 32)
  const auto on_sphere = [&](Pixel p) {
    const double x = p.x - 32;
    const double y = p.y - 32;
    return Vec3{x, y, std::sqrt(radius * radius - x * x - y * y)} / radius;
  };
  const Pixel from{28, 30};
  const Pixel to{38, 33};
  const double arc = radius * std::acos(glm::dot(on_sphere(from), on_sphere(to)));
  const auto path = line_over(mesh, from, to);
  REQUIRE(path);
  const GeodesicMatch found = match(mesh, *path);
  REQUIRE(found.is_judged);
  CHECK(found.shortest == Approx(arc).epsilon(2e-3));
  CHECK(found.length >= found.shortest * (1.0 - 1e-9));
  CHECK(found.line >= found.length * (1.0 - 1e-9));
}

TEST_CASE("a path the long way round is noticed by its length") {
  // Six triangles around the origin. From the middle of one to that of the next it is r, the
  // distance of both from the origin; through all the others the way bends at the origin: 2 r.
  TriangleMesh mesh;
  mesh.positions.emplace_back(0.0);
  for (int i = 0; i < 6; ++i) {
    const double angle = std::numbers::pi * i / 3.0;
    mesh.positions.emplace_back(std::cos(angle), std::sin(angle), 0.0);
  }
  for (std::uint32_t i = 0; i < 6; ++i)
    mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % 6});
  const auto middle = [&](std::uint32_t f) {
    const auto& [a, b, c] = mesh.triangles[f];
    return (mesh.positions[a] + mesh.positions[b] + mesh.positions[c]) / 3.0;
  };
  SurfacePath around{.faces = {0, 5, 4, 3, 2, 1}, .points = {middle(0)}};
  for (const std::uint32_t spoke : {1U, 6U, 5U, 4U, 3U})
    around.points.push_back(0.5 * mesh.positions[spoke]);
  around.points.push_back(middle(1));
  const double r = glm::length(middle(0));
  const GeodesicMatch found = match(mesh, around);
  REQUIRE(found.is_judged);
  CHECK(found.length == Approx(2.0 * r).epsilon(1e-9));
  CHECK(found.shortest == Approx(r).epsilon(1e-9));
  CHECK(found.deviation == Approx(r * std::sqrt(0.75)).epsilon(1e-9));  // of the origin
}

TEST_CASE("a line does not arrive over a gap, on another sheet, or from a face beside its start") {
  TriangleMesh mesh = test::merged(test::lattice({10.0, 10.0}, 8, 8, 1.0, 20.0),
                                   test::lattice({18.5, 10.0}, 8, 8, 1.0, 20.0));
  CHECK(line_over(mesh, {12, 12}, {17, 14}));
  CHECK_FALSE(line_over(mesh, {17, 14}, {20, 14}));
  const TriangleMesh sheets = test::merged(test::lattice({10.0, 10.0}, 8, 8, 1.0, 20.0),
                                           test::lattice({10.0, 10.0}, 8, 8, 1.0, 25.0));
  const ViewedMesh seen(sheets, kView);
  const std::uint32_t start = face_below(sheets, {12, 12});
  const std::uint32_t end = face_below(sheets, {13, 14});
  CHECK(follow_line(seen, {{12, 12}, start}, {{13, 14}, end}));
  CHECK_FALSE(follow_line(seen, {{12, 12}, start}, {{13, 14}, end + 128}));  // below it
  CHECK_FALSE(follow_line(seen, {{12, 12}, start + 40}, {{13, 14}, end}));
}

TEST_CASE("paths that are none are refused") {
  const TriangleMesh mesh = roof(1.0);
  const auto judge = [&](SurfacePath path) { return match(mesh, path); };
  CHECK_THROWS_AS(judge({}), InvalidArgument);
  CHECK_THROWS_AS(judge({.faces = {0}, .points = {{}}}), InvalidArgument);
  CHECK_THROWS_AS(judge({.faces = {2}, .points = {{}, {}}}), InvalidArgument);
}
