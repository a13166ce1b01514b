#include "core/finish/border_gaps.h"

#include <catch2/catch.hpp>
#include <vector>

namespace rangezip {
namespace {

constexpr double kH = 1.0;
const Box kRegion{Vec3(-10.0), Vec3(10.0)};

/// Two triangles that make the square [0, 2]^2 at z = 0, facing up.
TriangleMesh square() {
  return {{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, {{0, 1, 2}, {0, 2, 3}}, {}};
}

std::vector<BorderGap> gaps_of(const TriangleMesh& mesh, const std::vector<Vec3>& points) {
  const CornerTable table(mesh.triangles, mesh.positions.size());
  const FaceGrid faces(mesh, table, kH);
  return find_border_gaps(mesh, table, faces, PointGrid(points, kRegion, 0.7), {kH, 1e-3});
}

TEST_CASE("a point beside an edge is a gap as wide as the point is beyond it") {
  const auto gaps = gaps_of(square(), {{0.5, -0.25, 0.125}});
  REQUIRE(gaps.size() == 1);
  const BorderGap& gap = gaps[0];
  REQUIRE(gap.corner == 0);  // from vertex 0 to 1
  REQUIRE(gap.share == 0.25);
  REQUIRE(gap.beyond == 0.25);
  REQUIRE(gap.height == 0.125);
  REQUIRE(gap.outward == Vec3(0, -1, 0));
  REQUIRE(gap.normal == Vec3(0, 0, 1));
}

TEST_CASE("of several points beyond an edge the farthest is its gap") {
  const auto gaps = gaps_of(square(), {{0.5, -0.25, 0}, {1.0, -0.75, 0}, {1.5, -0.5, 0}});
  REQUIRE(gaps.size() == 1);
  REQUIRE(gaps[0].beyond == 0.75);
}

TEST_CASE("points over the mesh, on it, or farther than the reach make no gap") {
  REQUIRE(gaps_of(square(), {{1, 1, 0}, {1, 0.01, 0.5}, {1, 0, 0.5}}).empty());
  REQUIRE(gaps_of(square(), {{1, -1.01, 0}, {1, -0.9, 0.9}}).empty());
}

TEST_CASE("a point beyond a corner of the border is a gap of both edges, as far as beyond either") {
  const auto gaps = gaps_of(square(), {{-0.5, -0.25, 0}});
  REQUIRE(gaps.size() == 2);
  for (const BorderGap& gap : gaps)
    REQUIRE(gap.beyond == 0.5);
}

TEST_CASE("a point nearer to another part of the mesh is no gap of the border") {
  TriangleMesh mesh = square();
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vec3 p : {Vec3(-3, -0.6, -3), Vec3(5, -0.6, -3), Vec3(1, -0.6, 5)})
    mesh.positions.push_back(p);
  mesh.triangles.push_back({first, first + 1, first + 2});
  REQUIRE(gaps_of(mesh, {{1, -0.5, 0}}).empty());
  REQUIRE(gaps_of(mesh, {{1, -0.2, 0}}).size() == 1);
}

}  // namespace
}  // namespace rangezip
