#include "compare/mesh_judge.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/mesh/mesh_report.h"
#include "tests/compare/cubes.h"

using namespace rangezip;
using namespace rangezip::compare;

namespace {

using FacePairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// A horizontal triangle and an upright one through its middle; they share no vertex.
TriangleMesh crossing_triangles() {
  TriangleMesh mesh;
  mesh.positions = {{-2, -1, 0}, {2, -1, 0}, {0, 2, 0}, {0, 0, -1}, {0, 0.5, 1}, {0, -0.5, 1}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  return mesh;
}

/// Two triangles that share an edge and lie on top of each other, away from crossing_triangles().
TriangleMesh folded_triangles() {
  TriangleMesh mesh;
  mesh.positions = {{10, 0, 0}, {12, 0, 0}, {11, 2, 0}, {11, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}};
  return mesh;
}

}  // namespace

TEST_CASE("a cube is clean, closed, of its volume and of Euler number 2") {
  const MeshVerdict verdict = judge_mesh(test::cube(1.5));
  CHECK(verdict.is_clean());
  CHECK(verdict.vertices == 8);
  CHECK(verdict.faces == 12);
  CHECK(verdict.components == 1);
  CHECK(verdict.boundary_loops == 0);
  CHECK(verdict.euler == 2);
  REQUIRE(verdict.volume);
  CHECK(*verdict.volume == Approx(27.0).epsilon(1e-12));
}

TEST_CASE("a cube turned inside out has a negative volume") {
  TriangleMesh mesh = test::cube(1.0);
  for (Triangle& t : mesh.triangles)
    std::swap(t[1], t[2]);
  const MeshVerdict verdict = judge_mesh(mesh);
  CHECK(verdict.is_clean());
  REQUIRE(verdict.volume);
  CHECK(*verdict.volume == Approx(-8.0).epsilon(1e-12));
}

TEST_CASE("open and separate pieces are counted") {
  TriangleMesh open = test::cube(1.0);
  open.triangles.resize(10);  // without the side x = 1
  const MeshVerdict verdict = judge_mesh(test::together(open, test::cube(1.0, {5, 0, 0})));
  CHECK(verdict.is_clean());
  CHECK(verdict.components == 2);
  CHECK(verdict.boundary_loops == 1);
  CHECK(verdict.euler == 1 + 2);
  CHECK_FALSE(verdict.volume);
}

TEST_CASE("positions that no face uses do not count") {
  TriangleMesh mesh = test::cube(1.0);
  mesh.positions.insert(mesh.positions.begin(), Vec3{9.0});
  for (Triangle& t : mesh.triangles) {
    for (std::uint32_t& corner : t)
      ++corner;
  }
  CHECK(judge_mesh(mesh).vertices == 8);
  CHECK(judge_mesh(mesh).euler == 2);
}

TEST_CASE("what is no manifold is called so") {
  SECTION("three faces at an edge") {
    TriangleMesh mesh = test::strip(1);
    mesh.positions.push_back({0.5, 0.5, 1.0});
    mesh.triangles.push_back({3, 0, 4});
    CHECK_FALSE(judge_mesh(mesh).is_manifold);
  }
  SECTION("neighbours of opposite orientation") {
    TriangleMesh mesh = test::strip(1);
    std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);
    CHECK_FALSE(judge_mesh(mesh).is_manifold);
  }
  SECTION("two fans at a vertex") {
    TriangleMesh mesh = test::strip(1);
    mesh.positions.insert(mesh.positions.end(), {{2, 2, 0}, {1, 2, 0}});
    mesh.triangles.push_back({3, 4, 5});
    CHECK_FALSE(judge_mesh(mesh).is_manifold);
  }
  SECTION("a repeated corner") {
    TriangleMesh mesh = test::strip(1);
    mesh.triangles.push_back({0, 0, 1});
    CHECK_FALSE(judge_mesh(mesh).is_manifold);
  }
}

TEST_CASE("crossing and folded triangles are found as one pair each") {
  CHECK(cgal_self_intersections(crossing_triangles()) == FacePairs{{0, 1}});
  CHECK(cgal_self_intersections(folded_triangles()) == FacePairs{{0, 1}});
  const MeshVerdict verdict = judge_mesh(test::together(crossing_triangles(), folded_triangles()));
  CHECK(verdict.is_manifold);
  CHECK(verdict.self_intersections == 2);
  CHECK_FALSE(verdict.is_clean());
}

TEST_CASE("cubes that overlap intersect, cubes apart do not") {
  CHECK(judge_mesh(test::together(test::cube(1.0), test::cube(1.0, {2.5, 0, 0}))).is_clean());
  const TriangleMesh overlapping =
      test::together(test::cube(1.0), test::cube(1.0, {0.9, 0.8, 0.7}));
  const FacePairs pairs = cgal_self_intersections(overlapping);
  CHECK_FALSE(pairs.empty());
  CHECK(std::ranges::is_sorted(pairs));
  CHECK(std::ranges::all_of(pairs, [](const auto& p) { return p.first < 12 && p.second >= 12; }));
  CHECK(judge_mesh(overlapping).self_intersections == pairs.size());
}

TEST_CASE("a face without area is degenerate, not a self-intersection") {
  TriangleMesh mesh = test::strip(1);
  mesh.positions.insert(mesh.positions.end(), {{5, 0, 0}, {6, 0, 0}, {7, 0, 0}});
  mesh.triangles.push_back({4, 5, 6});
  const MeshVerdict verdict = judge_mesh(mesh);
  CHECK(verdict.degenerate_faces == 1);
  CHECK(verdict.self_intersections == 0);
  CHECK_FALSE(verdict.is_clean());
}

TEST_CASE("CGAL and report_mesh agree on random sets of triangles") {
  std::size_t manifold = 0;
  constexpr std::uint64_t kSeeds = 300;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    CAPTURE(seed);
    shapes::Random random(seed);
    TriangleMesh mesh;
    for (int i = 0; i < 9; ++i)
      mesh.positions.push_back(test::random_point(random));
    const std::size_t faces = 2 + seed % 4;
    while (mesh.triangles.size() < faces) {
      const auto corner = [&] { return static_cast<std::uint32_t>(random.bits() % 9); };
      const Triangle t{corner(), corner(), corner()};
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) mesh.triangles.push_back(t);
    }
    const MeshVerdict verdict = judge_mesh(mesh);
    const MeshReport report = report_mesh(mesh);
    CHECK(verdict.is_manifold == report.is_manifold());
    CHECK(verdict.vertices == report.vertices);
    if (!verdict.is_manifold) continue;
    ++manifold;
    CHECK(verdict.components == report.components);
    CHECK(verdict.boundary_loops == report.boundary_loops);
    CHECK(verdict.euler == report.euler);
  }
  // Both kinds occur, or the loop has shown nothing.
  CHECK(manifold > kSeeds / 20);
  CHECK(manifold < kSeeds - kSeeds / 20);
}

TEST_CASE("what cannot be judged is refused") {
  TriangleMesh torn = test::strip(1);
  torn.triangles[1][0] = 17;
  CHECK_THROWS_AS(judge_mesh(torn), TopologyError);
  CHECK_THROWS_AS(cgal_self_intersections(torn), TopologyError);

  TriangleMesh infinite = test::strip(1);
  infinite.positions[0].x = std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(judge_mesh(infinite), TopologyError);

  TriangleMesh misoriented = test::strip(1);
  std::swap(misoriented.triangles[0][0], misoriented.triangles[0][1]);
  CHECK_THROWS_AS(cgal_self_intersections(misoriented), TopologyError);
}
