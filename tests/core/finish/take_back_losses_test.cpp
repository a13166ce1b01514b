#include "core/finish/take_back_losses.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/finish/point_grid.h"
#include "core/mesh/mesh_report.h"
#include "core/mesh/self_intersection.h"
#include "tests/core/finish/shapes.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

constexpr double kH = 1.0;
constexpr std::uint32_t kSide = 24;
const Box kRegion{Vec3(-24.0), Vec3(24.0)};

double reach_of(const Vec3& p) {
  return std::max(std::abs(p.x), std::abs(p.y));
}

/// A square sheet without the faces that have a corner in the square up to this from its middle.
TriangleMesh sheet_with_hole(double reach) {
  TriangleMesh mesh = shapes::square_sheet(kSide);
  testing::cut_where(mesh, [&](const Vec3& p) { return reach_of(p) < reach; });
  return mesh;
}

double area_of(const TriangleMesh& mesh) {
  double area = 0.0;
  for (const Triangle& t : mesh.triangles)
    area += area_of_face(mesh.positions, t);
  return area;
}

/// Two faces that stand upright across the middle of the sheet, this far up and down.
void add_post(TriangleMesh& mesh, double half) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const auto& [x, z] : {std::pair{-half, -half}, {half, -half}, {half, half}, {-half, half}})
    mesh.positions.emplace_back(x, 0.1, z);
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

/// Points on the square sheet, or above it, so far apart along both sides.
PointGrid cloud_on(double spacing, double z = 0.0, double reach = 0.5 * kSide) {
  std::vector<Vec3> points;
  const int most = static_cast<int>(reach / spacing);
  for (int y = -most; y <= most; ++y) {
    for (int x = -most; x <= most; ++x)
      points.emplace_back(spacing * x, spacing * y, z);
  }
  return {points, kRegion, kH};
}

std::size_t take_back_losses(TriangleMesh& mesh, const TriangleMesh& before, const PointGrid& cloud,
                             double h) {
  return rangezip::take_back_losses(mesh, before, &cloud, h);
}

TEST_CASE("what was cleared around a loop in vain comes back, whatever numbers vertices have",
          "[finish]") {
  const TriangleMesh crack = sheet_with_hole(0.5);
  TriangleMesh mesh = sheet_with_hole(3.5);
  const std::size_t cleared = crack.triangles.size() - mesh.triangles.size();
  REQUIRE(take_back_losses(mesh, crack, cloud_on(0.5), kH) == cleared);
  CHECK(area_of(mesh) == area_of(crack));
  CHECK(mesh.positions.size() == crack.positions.size());
  CHECK(report_mesh(mesh).boundary_loops == 2);
  CHECK(report_mesh(mesh).is_manifold());
}

TEST_CASE("a hole that was closed, or leaves few points out, stays as it is", "[finish]") {
  TriangleMesh closed = shapes::square_sheet(kSide);
  const TriangleMesh before = closed;
  CHECK(take_back_losses(closed, sheet_with_hole(3.5), cloud_on(0.5), kH) == 0);
  CHECK(closed == before);
  // It is 2 from the middle to the rim: 5 x 5 points are left out, or 11 x 11.
  TriangleMesh little = sheet_with_hole(1.5);
  CHECK(take_back_losses(little, sheet_with_hole(0.5), cloud_on(0.5), kH) == 0);
  CHECK(take_back_losses(little, sheet_with_hole(0.5), cloud_on(0.25), kH) > 0);
}

TEST_CASE("a piece of which nothing is left comes back, if it is large enough and the cloud has it",
          "[finish]") {
  const TriangleMesh sheet = shapes::square_sheet(kSide);
  TriangleMesh both = sheet;
  TriangleMesh piece = shapes::square_sheet(kSide);
  testing::cut_where(piece, [](const Vec3& p) { return reach_of(p) > 3.5; });
  for (Vec3& p : piece.positions)
    p.z += 20.0;
  testing::append(both, piece);
  const double area = area_of(piece);
  TriangleMesh mesh = sheet;
  CHECK(take_back_losses(mesh, both, nullptr, 0.99 * std::sqrt(area / 10.0)) ==
        piece.triangles.size());
  mesh = sheet;
  CHECK(take_back_losses(mesh, both, nullptr, 1.01 * std::sqrt(area / 10.0)) == 0);
  CHECK(mesh == sheet);
  CHECK(take_back_losses(mesh, both, cloud_on(0.5, 20.0), kH) == piece.triangles.size());
  CHECK(area_of(mesh) == Approx(area_of(both)));
  CHECK(report_mesh(mesh).components == 2);
  mesh = sheet;
  CHECK(take_back_losses(mesh, both, cloud_on(0.5), kH) == 0);
  CHECK(mesh == sheet);
}

TEST_CASE("of a component that has gone all comes back, of one with a hole nothing", "[finish]") {
  TriangleMesh both = sheet_with_hole(0.5);
  TriangleMesh piece = shapes::square_sheet(kSide);
  for (Vec3& p : piece.positions)
    p.z += 20.0;
  testing::append(both, piece);
  std::vector<Vec3> points = cloud_on(0.5).points(10'000);
  for (const Vec3& p : cloud_on(0.5, 20.0).points(10'000))
    points.push_back(p);
  const PointGrid cloud(points, kRegion, kH);
  TriangleMesh mesh = sheet_with_hole(3.5);
  CHECK(take_back_vanished(mesh, both, cloud, kH) == piece.triangles.size());
  CHECK(report_mesh(mesh).components == 2);
  CHECK(area_of(mesh) == Approx(area_of(sheet_with_hole(3.5)) + area_of(piece)));
}

TEST_CASE("without a cloud the area that is lost decides", "[finish]") {
  const TriangleMesh crack = sheet_with_hole(0.5);
  TriangleMesh little = sheet_with_hole(1.5);
  const double lost = area_of(crack) - area_of(little);
  CHECK(take_back_losses(little, crack, nullptr, 1.01 * std::sqrt(lost / 10.0)) == 0);
  CHECK(take_back_losses(little, crack, nullptr, 0.99 * std::sqrt(lost / 10.0)) > 0);
}

TEST_CASE("what was replaced by less surface, with the points, does not come back", "[finish]") {
  TriangleMesh flat = shapes::square_sheet(kSide);
  TriangleMesh tower = flat;  // one vertex, moved far out
  const auto middle =
      std::min_element(tower.positions.begin(), tower.positions.end(),
                       [](const Vec3& a, const Vec3& b) { return reach_of(a) < reach_of(b); });
  middle->z = 50.0;
  const TriangleMesh before = flat;
  REQUIRE(area_of(tower) > area_of(flat) + 40.0);
  CHECK(take_back_losses(flat, tower, cloud_on(0.1), kH) == 0);
  CHECK(flat == before);
}

TEST_CASE("faces do not come back through what is new", "[finish]") {
  const TriangleMesh crack = sheet_with_hole(0.5);
  TriangleMesh narrow = sheet_with_hole(3.5);
  add_post(narrow, 0.5);  // in the crack itself
  CHECK(take_back_losses(narrow, crack, cloud_on(0.5), kH) > 0);
  CHECK(self_intersections(narrow).empty());
  TriangleMesh wide = sheet_with_hole(3.5);
  add_post(wide, 2.5);
  const TriangleMesh before = wide;
  CHECK(take_back_losses(wide, crack, cloud_on(0.25), kH) == 0);
  CHECK(area_of(wide) == area_of(before));
}

}  // namespace
}  // namespace rangezip
