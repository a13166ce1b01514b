#include "core/finish/thin_handles.h"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "core/finish/clean_topology.h"
#include "core/finish/hole_filling.h"
#include "core/mesh/mesh_report.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

constexpr double kThin = 0.06;  ///< radius of what is thin in these shapes
constexpr double kGirth = 2.0 * std::numbers::pi * kThin;
constexpr double kAnyHole = 1e6;

/// Handles and tunnels, with every boundary loop taken as filled.
std::ptrdiff_t genus_of(const TriangleMesh& mesh) {
  const MeshReport report = report_mesh(mesh);
  REQUIRE(report.is_manifold());
  const auto euler = report.euler + static_cast<std::ptrdiff_t>(report.boundary_loops);
  return static_cast<std::ptrdiff_t>(report.components) - euler / 2;
}

/// What is left after the holes of a cut are closed.
TriangleMesh closed(TriangleMesh mesh) {
  clean_topology(mesh);
  remove_unused_vertices(mesh);
  return fill_mesh_holes(std::move(mesh), 0.1, kAnyHole).mesh;
}

}  // namespace

TEST_CASE("a thin ring is cut open where it is shorter around than asked for, and only then") {
  const TriangleMesh ring = shapes::to_mesh(shapes::torus(1.0, kThin));
  TriangleMesh kept = ring;
  CHECK(cut_thin_handles(kept, {.max_girth = 0.95 * kGirth}) == 0);
  CHECK(kept.triangles == ring.triangles);
  TriangleMesh cut = ring;
  CHECK(cut_thin_handles(cut, {.max_girth = 1.05 * kGirth}) == 1);
  const TriangleMesh healed = closed(std::move(cut));
  CHECK(genus_of(healed) == 0);
  CHECK(report_mesh(healed).components == 1);
  CHECK(report_mesh(healed).boundary_loops == 0);
}

TEST_CASE("a narrow tunnel is closed like a thin handle") {
  TriangleMesh mesh = shapes::to_mesh(shapes::torus(1.0, 1.0 - kThin));
  CHECK(cut_thin_handles(mesh, {.max_girth = 1.05 * kGirth}) == 1);
  CHECK(genus_of(closed(std::move(mesh))) == 0);
}

TEST_CASE("of several bodies only the thin one is cut") {
  const TriangleSoup thick = shapes::torus();
  const TriangleSoup thin =
      shapes::moved(shapes::torus(1.0, kThin), shapes::translation({4.0, 0.0, 0.0}));
  TriangleMesh mesh = shapes::to_mesh(shapes::merged(thick, thin));
  REQUIRE(genus_of(mesh) == 2);
  CHECK(cut_thin_handles(mesh, {.max_girth = 1.05 * kGirth}) == 1);
  mesh = closed(std::move(mesh));
  CHECK(genus_of(mesh) == 1);
  CHECK(cut_thin_handles(mesh, {.max_girth = 1.05 * kGirth}) == 0);
}

TEST_CASE(
    "a handle that no point lies near is cut though it is not thin, one with points is kept") {
  const TriangleSoup soup = shapes::torus(1.0, 0.3);
  const double girth = 2.0 * std::numbers::pi * 0.3;
  std::vector<Vec3> points = shapes::to_points(shapes::sampled(soup, 40'000));
  const Box region{Vec3(-2.0), Vec3(2.0)};
  const PointGrid whole(points, region, 0.1);
  TriangleMesh kept = shapes::to_mesh(soup);
  CHECK(cut_thin_handles(kept, {.max_girth = 0.5 * girth, .gaps = {&whole, 0.1}}) == 0);
  std::erase_if(points, [](const Vec3& p) { return p.x > 0.3 && std::abs(p.y) < 0.6; });
  const PointGrid part(points, region, 0.1);
  TriangleMesh cut = shapes::to_mesh(soup);
  CHECK(cut_thin_handles(cut, {.max_girth = 0.5 * girth, .gaps = {&part, 0.1}}) == 1);
  CHECK(genus_of(closed(std::move(cut))) == 0);
}

TEST_CASE("a longer handle is cut if points lie inside, and kept if they lie on it only") {
  const double tube = 0.3, girth = 2.0 * std::numbers::pi * tube;
  const TriangleSoup soup = shapes::torus(1.0, tube);
  std::vector<Vec3> points = shapes::to_points(shapes::sampled(soup, 40'000));
  const Box region{Vec3(-2.0), Vec3(2.0)};
  const PointGrid hollow(points, region, 0.1);
  TriangleMesh kept = shapes::to_mesh(soup);
  CHECK(cut_thin_handles(kept, {.filled_girth = 1.1 * girth, .cloud = {&hollow, 0.1}}) == 0);
  const TriangleSoup core = shapes::torus(1.0, 0.2 * tube);
  const std::vector<Vec3> inside = shapes::to_points(shapes::sampled(core, 10'000));
  points.insert(points.end(), inside.begin(), inside.end());
  const PointGrid filled(points, region, 0.1);
  CHECK(cut_thin_handles(kept, {.filled_girth = 0.9 * girth, .cloud = {&filled, 0.1}}) == 0);
  CHECK(cut_thin_handles(kept, {.filled_girth = 1.1 * girth, .cloud = {&filled, 0.1}}) == 1);
  CHECK(genus_of(closed(std::move(kept))) == 0);
}

TEST_CASE(
    "a narrow tunnel whose wall has points stays, and a handle as thin goes with or without") {
  constexpr double kH = kGirth / 5.0;
  const Box region{Vec3(-2.5), Vec3(2.5)};
  const TriangleSoup tunnel = shapes::torus(1.0, 1.0 - kThin);
  const PointGrid wall(shapes::to_points(shapes::sampled(tunnel, 100'000)), region, kH);
  TriangleMesh kept = shapes::to_mesh(tunnel);
  CHECK(cut_thin_handles(kept, {.max_girth = 1.05 * kGirth, .cloud = {&wall, kH}}) == 0);
  const TriangleSoup ring = shapes::torus(1.0, kThin);
  const PointGrid around(shapes::to_points(shapes::sampled(ring, 40'000)), region, kH);
  TriangleMesh cut = shapes::to_mesh(ring);
  CHECK(cut_thin_handles(cut, {.max_girth = 1.05 * kGirth, .cloud = {&around, kH}}) == 1);
}

TEST_CASE("a tunnel is closed that leads through a wall where no points are") {
  constexpr double kHole = 0.2;  // half as wide
  constexpr double kAround = 2.0 * std::numbers::pi * kHole;
  constexpr double kH = kAround / 7.0;
  const TriangleSoup soup = shapes::torus(1.0, 1.0 - kHole);
  const ThinHandleOptions options{.max_girth = 0.8 * kAround, .filled_girth = 1.3 * kAround};
  const Box region{Vec3(-2.5), Vec3(2.5)};
  std::vector<Vec3> points = shapes::to_points(shapes::sampled(soup, 100'000));
  const PointGrid all(points, region, kH);
  TriangleMesh mesh = shapes::to_mesh(soup);
  ThinHandleOptions with_points = options;
  with_points.cloud = {&all, kH};
  CHECK(cut_thin_handles(mesh, with_points) == 0);
  std::erase_if(points,
                [](const Vec3& p) { return std::hypot(p.x, p.y) < 0.5 && std::abs(p.z) < 0.4; });
  const PointGrid outside(points, region, kH);
  ThinHandleOptions without = options;
  without.cloud = {&outside, kH};
  CHECK(cut_thin_handles(mesh, without) == 1);
  CHECK(genus_of(closed(std::move(mesh))) == 0);
}

TEST_CASE("the ends of an open tube make no handle of it, nor do bodies without any") {
  constexpr std::array<Vec2, 3> kProfile{Vec2{kThin, 0.0}, Vec2{kThin, 0.1}, Vec2{kThin, 0.2}};
  TriangleMesh tube = shapes::to_mesh(shapes::revolved(kProfile, false));
  CHECK(cut_thin_handles(tube, {.max_girth = 10.0 * kGirth}) == 0);
  TriangleMesh ball = shapes::to_mesh(shapes::sphere());
  CHECK(cut_thin_handles(ball, {.max_girth = 100.0}) == 0);
  TriangleMesh nothing;
  CHECK(cut_thin_handles(nothing, {.max_girth = 1.0}) == 0);
}

}  // namespace rangezip
