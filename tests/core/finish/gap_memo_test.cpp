#include "core/finish/gap_memo.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "core/finish/clean_topology.h"
#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

constexpr int kSide = 24;
constexpr BorderGapOptions kOptions{.reach = 1.0, .negligible = 1e-3};
const Box kRegion{Vec3(-3.0), Vec3(kSide + 3.0)};

/// A wavy sheet of unit squares.
TriangleMesh sheet() {
  TriangleMesh mesh;
  for (std::uint32_t y = 0; y <= kSide; ++y) {
    for (std::uint32_t x = 0; x <= kSide; ++x)
      mesh.positions.emplace_back(x, y, 0.3 * std::sin(x));
  }
  for (std::uint32_t y = 0; y < kSide; ++y) {
    for (std::uint32_t x = 0; x < kSide; ++x) {
      const std::uint32_t a = y * (kSide + 1) + x, b = a + kSide + 1;
      mesh.triangles.push_back({a, a + 1, b + 1});
      mesh.triangles.push_back({a, b + 1, b});
    }
  }
  return mesh;
}

PointGrid cloud_around(std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::vector<Vec3> points;
  for (int i = 0; i < 8000; ++i) {
    const double x = testing::uniform(engine, -1.5, kSide + 1.5);
    const double y = testing::uniform(engine, -1.5, kSide + 1.5);
    points.emplace_back(x, y, 0.3 * std::sin(x) + testing::uniform(engine, -0.2, 0.2));
  }
  return {points, kRegion, 0.5};
}

/// Takes faces away, moves vertices a little, and puts triangles before edges.
void change(TriangleMesh& mesh, std::mt19937_64& engine) {
  const auto any = [&](std::size_t count) { return engine() % count; };
  std::vector<Triangle>& triangles = mesh.triangles;
  for (int i = 0; i < 4; ++i)
    triangles.erase(triangles.begin() + static_cast<std::ptrdiff_t>(any(triangles.size())));
  for (int i = 0; i < 2; ++i)
    mesh.positions[any(mesh.positions.size())].z += testing::uniform(engine, -0.2, 0.2);
  const CornerTable table(triangles, mesh.positions.size());
  for (std::uint32_t c = 0; c < table.corner_count(); ++c) {
    if (table.across(c) != CornerTable::kNone || any(80) != 0) continue;
    const std::uint32_t a = table.vertex(c), b = table.head(c);
    const Vec3 out = mesh.positions[a] + mesh.positions[b] - mesh.positions[table.apex(c)];
    triangles.push_back({b, a, static_cast<std::uint32_t>(mesh.positions.size())});
    mesh.positions.push_back(out);
  }
  clean_topology(mesh);
}

void require_same(const std::vector<BorderGap>& found, const std::vector<BorderGap>& expected) {
  REQUIRE(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const BorderGap &a = found[i], &b = expected[i];
    REQUIRE(a.corner == b.corner);
    REQUIRE(a.point == b.point);
    REQUIRE(a.share == b.share);
    REQUIRE(a.beyond == b.beyond);
    REQUIRE(a.height == b.height);
    REQUIRE(a.outward == b.outward);
    REQUIRE(a.normal == b.normal);
  }
}

TEST_CASE("what is remembered of gaps is what is found by looking at the whole border again") {
  const std::uint64_t seed = GENERATE(1U, 2U, 3U);
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  const PointGrid cloud = cloud_around(seed);
  TriangleMesh mesh = sheet();
  GapMemo memo(cloud, kOptions);
  std::size_t looked_at = 0, gaps = 0, remembered = 0;
  for (int round = 0; round < 60; ++round) {
    CAPTURE(round);
    const CornerTable table(mesh.triangles, mesh.positions.size());
    const FaceGrid faces(mesh, table, kOptions.reach);
    const std::vector<BorderGap> found = memo.find(mesh, table, faces);
    require_same(found, find_border_gaps(mesh, table, faces, cloud, kOptions));
    looked_at += memo.looked_at();
    gaps += found.size();
    if (memo.looked_at() < found.size()) remembered += found.size() - memo.looked_at();
    change(mesh, engine);
  }
  REQUIRE(gaps > 1000);
  REQUIRE(remembered > 100);
  REQUIRE(looked_at > 1000);
}

TEST_CASE("only border edges near what has changed are looked at again") {
  const PointGrid cloud = cloud_around(4);
  TriangleMesh mesh = sheet();
  GapMemo memo(cloud, kOptions);
  const auto look = [&] {
    const CornerTable table(mesh.triangles, mesh.positions.size());
    static_cast<void>(memo.find(mesh, table, FaceGrid(mesh, table, kOptions.reach)));
    return memo.looked_at();
  };
  REQUIRE(look() == 4 * kSide);
  REQUIRE(look() == 0);
  mesh.triangles.erase(mesh.triangles.begin());  // at the corner
  const std::size_t near = look();
  REQUIRE(near >= 3);
  REQUIRE(near < kSide);
  mesh.positions[kSide / 2 * (kSide + 2)].z += 0.1;  // in the middle, far from the border
  REQUIRE(look() == 0);
}

}  // namespace
}  // namespace rangezip
