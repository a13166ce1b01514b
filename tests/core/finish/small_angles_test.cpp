#include "core/finish/small_angles.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "core/finish/border_gaps.h"
#include "core/finish/extend_border.h"
#include "core/mesh/mesh_report.h"
#include "core/mesh/self_intersection.h"
#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

using testing::uniform;

constexpr int kN = 16;
constexpr double kH = 2.0 / kN;
constexpr double kTenDegrees = 0.1745;
constexpr double kThirtyDegrees = 0.5236;
const Box kRegion{Vec3(-2.5), Vec3(2.5)};

PointGrid grid_of(const std::vector<Vec3>& points) {
  return PointGrid(points, kRegion, 0.7 * kH);
}

/// The square [-1, 1]^2 at z = 0, facing up; a fiftieth of its vertices went astray by up to 0.9 h,
/// those on its border along it.
TriangleMesh sheet(std::uint64_t seed) {
  TriangleMesh mesh = testing::cube(kN);
  testing::cut_where(mesh, [](const Vec3& p) { return p.z < 1.0; });
  std::mt19937_64 engine(seed);
  const auto stray = [&](double x) {
    return std::abs(x) > 0.99 ? x : x + uniform(engine, -0.9, 0.9) * kH;
  };
  for (Vec3& p : mesh.positions) {
    p.z = 0.0;
    if (uniform(engine, 0.0, 1.0) < 0.02) p = Vec3(stray(p.x), stray(p.y), 0.0);
  }
  return mesh;
}

void require_same_topology(const TriangleMesh& before, const TriangleMesh& after) {
  const MeshReport was = report_mesh(before), is = report_mesh(after);
  REQUIRE(is.is_manifold());
  REQUIRE(is.components == was.components);
  REQUIRE(is.euler == was.euler);
  REQUIRE(is.boundary_loops == was.boundary_loops);
  REQUIRE(self_intersections(after).empty());
}

bool has_gap(const TriangleMesh& mesh, const PointGrid& cloud) {
  const CornerTable table(mesh.triangles, mesh.positions.size());
  const FaceGrid faces(mesh, table, kH);
  return !find_border_gaps(mesh, table, faces, cloud, {kH, 1.001e-3 * kH}).empty();
}

std::size_t faces_under(double angle, const TriangleMesh& mesh) {
  return static_cast<std::size_t>(
      std::count_if(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
        return testing::smallest_angle(TriangleMesh{mesh.positions, {t}, {}}) < angle;
      }));
}

TEST_CASE("no angle under ten degrees is left, and of the cloud nothing lies beyond the border") {
  std::mt19937_64 engine(7);
  std::vector<Vec3> points(9 * kN * kN);
  for (Vec3& p : points)
    p = {uniform(engine, -1, 1), uniform(engine, -1, 1), 0.0};
  const PointGrid cloud = grid_of(points);
  int tried = 0;
  std::size_t under_thirty = 0, left = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    CAPTURE(seed);
    const TriangleMesh before = sheet(seed);
    if (!self_intersections(before).empty()) continue;
    ++tried;
    TriangleMesh mesh = before;
    const SmallAngleReport report = mend_small_angles(mesh, cloud, kH);
    REQUIRE(report.left == 0);
    REQUIRE((report.mended == 0) == (mesh == before));
    under_thirty += faces_under(kThirtyDegrees, before);
    left += faces_under(kThirtyDegrees - 0.002, mesh);
    REQUIRE(testing::smallest_angle(mesh) > kTenDegrees - 0.002);
    require_same_topology(before, mesh);
    REQUIRE(!has_gap(mesh, cloud));
  }
  REQUIRE(tried > 10);
  REQUIRE(under_thirty > 100);
  REQUIRE(left < under_thirty / 10);
}

/// A sheet of squares with a thin face at its border, the longer the higher `i` is; its tip is
/// last.
TriangleMesh sheet_with_needle(int i) {
  TriangleMesh mesh = testing::cube(kN);
  testing::cut_where(mesh, [](const Vec3& p) { return p.z < 1.0; });
  const CornerTable table(mesh.triangles, mesh.positions.size());
  std::uint32_t c = 0;
  while (table.across(c) != CornerTable::kNone)
    ++c;
  const Vec3 a = mesh.positions[table.vertex(c)], along = mesh.positions[table.head(c)] - a;
  const Vec3 outward = glm::cross(along, Vec3(0.0, 0.0, 1.0));
  mesh.triangles.push_back(
      {table.head(c), table.vertex(c), static_cast<std::uint32_t>(mesh.positions.size())});
  mesh.positions.push_back(a + 0.5 * i * along + 0.04 * i * outward);
  return mesh;
}

TEST_CASE(
    "of a needle out to a far point of the cloud a mesh is left that can step out to it again") {
  for (int i = 1; i <= 20; ++i) {
    TriangleMesh mesh = sheet_with_needle(i);
    const PointGrid cloud = grid_of({mesh.positions.back()});
    REQUIRE(!has_gap(mesh, cloud));
    REQUIRE(mend_small_angles(mesh, cloud, kH).left == 0);
    extend_border(mesh, cloud, {.pixel_size = kH, .smallest_angle = kSmallAngle});
    REQUIRE(!has_gap(mesh, cloud));
    REQUIRE(testing::smallest_angle(mesh) > kTenDegrees - 0.002);
  }
}

/// With a small upright triangle at a place.
TriangleMesh with_obstacle(TriangleMesh mesh, const Vec3& place) {
  constexpr double kSize = 0.01 * kH;
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.push_back(place - Vec3(kSize, 0.0, kSize));
  mesh.positions.push_back(place + Vec3(kSize, 0.0, -kSize));
  mesh.positions.push_back(place + Vec3(0.0, 0.0, kSize));
  mesh.triangles.push_back({first, first + 1, first + 2});
  return mesh;
}

TEST_CASE("a needle does not get wider over an obstacle") {
  int obstacles = 0;
  for (int i = 1; i <= 20; ++i) {
    const TriangleMesh before = sheet_with_needle(i);
    const PointGrid cloud = grid_of({before.positions.back()});
    TriangleMesh wider = before;
    mend_small_angles(wider, cloud, kH);
    for (const Triangle& t : wider.triangles) {
      const Vec3 &p = wider.positions[t[0]], &q = wider.positions[t[1]], &r = wider.positions[t[2]];
      const TriangleMesh blocked = with_obstacle(before, (p + q + r) / 3.0);
      const auto obstacle = static_cast<std::uint32_t>(before.triangles.size());
      if (!self_intersections(blocked, {{obstacle}}).empty()) continue;
      ++obstacles;
      TriangleMesh mesh = blocked;
      mend_small_angles(mesh, cloud, kH);
      require_same_topology(blocked, mesh);
    }
  }
  REQUIRE(obstacles > 5);
}

TEST_CASE("a mesh without small angles does not change") {
  const TriangleMesh before = testing::sphere(8);
  TriangleMesh mesh = before;
  REQUIRE(mend_small_angles(mesh, grid_of({}), kH).mended == 0);
  REQUIRE(mesh == before);
}

}  // namespace
}  // namespace rangezip
