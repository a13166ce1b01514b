#include "core/mesh/self_intersection.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <random>

#include "core/base/parallel.h"
#include "core/mesh/triangle_overlap.h"
#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

TriangleMesh two_triangles(std::vector<Vec3> positions, Triangle second) {
  return {std::move(positions), {{0, 1, 2}, second}, {}};
}
bool meet(const TriangleMesh& mesh) {
  return overlap(mesh, mesh.triangles[0], mesh.triangles[1]);
}
const Vec3 kA(0, 0, 0), kB(4, 0, 0), kC(0, 4, 0);

TEST_CASE("a closed sphere has no self-intersections") {
  REQUIRE(self_intersections(testing::sphere(20)).empty());
  REQUIRE(self_intersections(testing::cube(10)).empty());
  REQUIRE(self_intersections(TriangleMesh{}).empty());
}

TEST_CASE("any touch of triangles without a common corner counts") {
  const auto touch = [](Vec3 p, Vec3 q, Vec3 r) {
    return meet(two_triangles({kA, kB, kC, p, q, r}, {3, 4, 5}));
  };
  REQUIRE(touch({1, 1, -1}, {1, 1, 1}, {2, 5, 1}));            // pierces
  REQUIRE(touch({1, 1, 0}, {1, 1, 1}, {2, 1, 1}));             // corner on the face
  REQUIRE(touch({2, 0, 0}, {2, -1, 1}, {2, -1, -1}));          // corner on a side
  REQUIRE(touch({0, 0, 0}, {-1, 0, 1}, {-1, 0, -1}));          // corner on a corner
  REQUIRE(touch({2, -1, 0}, {2, 1, 1}, {2, 1, -1}));           // crosses a side
  REQUIRE(touch({1, 1, 0}, {2, 1, 0}, {1, 2, 0}));             // inside, in one plane
  REQUIRE(touch({-8, -8, 0}, {20, -8, 0}, {-8, 20, 0}));       // around, in one plane
  REQUIRE(touch({2, 2, 0}, {4, 2, 0}, {2, 4, 0}));             // corner on a side, in one plane
  REQUIRE_FALSE(touch({1, 1, 1e-300}, {1, 1, 1}, {2, 1, 1}));  // just above
  REQUIRE_FALSE(touch({2, std::nextafter(2.0, 3.0), 0}, {4, 2, 1}, {4, 2, -1}));  // just beside
  REQUIRE_FALSE(touch({3, 3, 0}, {4, 3, 0}, {3, 4, 0}));
  REQUIRE_FALSE(touch({3, 3, -1}, {3, 3, 1}, {5, 5, 1}));  // crosses the plane outside
}

TEST_CASE("triangles with one common corner count only beyond it") {
  const auto fold = [](Vec3 p, Vec3 q) {
    return meet(two_triangles({kA, kB, kC, p, q}, {0, 3, 4}));
  };
  REQUIRE_FALSE(fold({-1, 0, 0}, {0, -1, 0}));  // on the other side, in one plane
  REQUIRE_FALSE(fold({1, 1, 1}, {1, 1, 3}));    // stands on the corner
  REQUIRE(fold({1, 1, -1}, {1, 1, 1}));         // cuts through
  REQUIRE(fold({1, 1, 0}, {1, 1, 1}));          // a corner lies on the face
  REQUIRE(fold({2, 0, 0}, {2, -1, 0}));         // a side lies on a side
  REQUIRE(fold({1, 2, 0}, {2, 1, 0}));          // lies on it
  REQUIRE(fold({20, -1, 0}, {-1, 20, 0}));      // covers it
}

TEST_CASE("triangles with a common edge count only when folded onto each other") {
  const auto fold = [](Vec3 p) { return meet(two_triangles({kA, kB, kC, p}, {1, 0, 3})); };
  REQUIRE_FALSE(fold({1, -1, 0}));
  REQUIRE_FALSE(fold({1, 1, 1}));
  REQUIRE_FALSE(fold({1, 1, 1e-300}));
  REQUIRE(fold({1, 1, 0}));
  REQUIRE(fold({-9, 1, 0}));
}

TEST_CASE("the same triangle twice counts, and back to back too") {
  REQUIRE(meet(two_triangles({kA, kB, kC}, {0, 1, 2})));
  REQUIRE(meet(two_triangles({kA, kB, kC}, {0, 2, 1})));
}

TEST_CASE("a triangle without area pairs with itself only") {
  const TriangleMesh mesh =
      two_triangles({kA, kB, kC, {1, 1, -1}, {1, 1, 0}, {1, 1, 1}}, {3, 4, 5});
  REQUIRE(self_intersections(mesh) == Pairs{{1, 1}});
}

TEST_CASE("a vertex pushed through the opposite wall is found, and nothing else") {
  TriangleMesh mesh = testing::sphere(16);
  const auto top = std::max_element(mesh.positions.begin(), mesh.positions.end(),
                                    [](const Vec3& a, const Vec3& b) { return a.z < b.z; });
  const auto moved = static_cast<std::uint32_t>(top - mesh.positions.begin());
  *top = Vec3(0.01, 0.02, -1.5);
  const Pairs pairs = self_intersections(mesh);
  REQUIRE_FALSE(pairs.empty());
  const auto has_moved = [&](std::uint32_t i) {
    const Triangle& t = mesh.triangles[i];
    return t[0] == moved || t[1] == moved || t[2] == moved;
  };
  for (const auto& [i, j] : pairs)
    REQUIRE((has_moved(i) != has_moved(j)));
}

TriangleMesh soup(std::uint64_t seed, std::size_t count, double size) {
  std::mt19937_64 engine(seed);
  TriangleMesh mesh;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 center{testing::uniform(engine, 0, 1), testing::uniform(engine, 0, 1),
                      testing::uniform(engine, 0, 1)};
    // A few are large, so that every path of the broad phase is taken.
    const double scale = i % 97 == 0 ? 0.9 : size;
    for (int k = 0; k < 3; ++k) {
      mesh.positions.push_back(center + scale * Vec3{testing::uniform(engine, -1, 1),
                                                     testing::uniform(engine, -1, 1),
                                                     testing::uniform(engine, -1, 1)});
    }
    const auto v = static_cast<std::uint32_t>(3 * i);
    mesh.triangles.push_back({v, v + 1, v + 2});
  }
  return mesh;
}

TEST_CASE("the grid finds the pairs that comparing all with all finds") {
  const std::uint64_t seed = GENERATE(1U, 2U, 3U);
  const double size = GENERATE(0.01, 0.05, 0.3);
  CAPTURE(seed, size);
  const TriangleMesh mesh = soup(seed, 600, size);
  Pairs expected;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    for (std::uint32_t j = i + 1; j < mesh.triangles.size(); ++j) {
      if (overlap(mesh, mesh.triangles[i], mesh.triangles[j])) expected.emplace_back(i, j);
    }
  }
  REQUIRE(self_intersections(mesh) == expected);
}

TEST_CASE(
    "slivers across the axes, which are in very many cells, are found to cross what they do") {
  constexpr std::uint64_t kSeed = 5;
  constexpr std::size_t kCount = 3000;
  TriangleMesh mesh = soup(kSeed, kCount, 0.004);
  for (std::size_t i = 0; i < kCount; i += 33) {
    const Vec3 start = 0.3 * mesh.positions[3 * i];
    mesh.positions[3 * i] = start;
    mesh.positions[3 * i + 1] = start + Vec3(0.6, 0.6, 0.61);
    mesh.positions[3 * i + 2] = start + Vec3(0.6, 0.61, 0.6);
  }
  Pairs expected;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    for (std::uint32_t j = i + 1; j < kCount; ++j) {
      if (overlap(mesh, mesh.triangles[i], mesh.triangles[j])) expected.emplace_back(i, j);
    }
  }
  REQUIRE(!expected.empty());
  REQUIRE(self_intersections(mesh) == expected);
}

TEST_CASE("only pairs with a changed triangle are reported when asked so") {
  const TriangleMesh mesh = soup(5, 2000, 0.05);
  const std::vector<std::uint32_t> changed{7, 97, 500, 3};
  Pairs expected;
  for (const auto& pair : self_intersections(mesh)) {
    const auto is_changed = [&](std::uint32_t i) {
      return std::find(changed.begin(), changed.end(), i) != changed.end();
    };
    if (is_changed(pair.first) || is_changed(pair.second)) expected.push_back(pair);
  }
  REQUIRE_FALSE(expected.empty());
  REQUIRE(self_intersections(mesh, changed) == expected);
  REQUIRE(self_intersections(mesh, std::vector<std::uint32_t>{}).empty());
}

TEST_CASE("triangles that are known to be apart are compared with all others only") {
  const TriangleMesh mesh = soup(6, 2000, 0.05);
  std::vector<std::uint32_t> changed(1000), apart(500);
  std::iota(changed.begin(), changed.end(), 0U);
  std::iota(apart.begin(), apart.end(), 0U);
  Pairs expected;
  for (const auto& [i, j] : self_intersections(mesh)) {
    if (i < 1000 && j >= 500) expected.emplace_back(i, j);
  }
  REQUIRE(expected.size() > 10);
  REQUIRE(expected.size() < self_intersections(mesh, changed).size());
  REQUIRE(self_intersections(mesh, changed, apart) == expected);
}

TEST_CASE("the verdict does not depend on the number of threads") {
  const TriangleMesh mesh = soup(6, 4000, 0.05);
  Pairs one, four;
  run_with_threads(1, [&] { one = self_intersections(mesh); });
  run_with_threads(4, [&] { four = self_intersections(mesh); });
  REQUIRE(one == four);
}

}  // namespace
}  // namespace rangezip
