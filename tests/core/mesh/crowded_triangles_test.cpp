#include "core/mesh/crowded_triangles.h"

#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <random>

#include "core/base/parallel.h"
#include "core/mesh/self_intersection.h"
#include "core/mesh/triangle_overlap.h"
#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
using testing::uniform;

Vec3 random_point(std::mt19937_64& engine, double lower, double upper) {
  const double x = uniform(engine, lower, upper), y = uniform(engine, lower, upper);
  return {x, y, uniform(engine, lower, upper)};
}

void add(TriangleMesh& mesh, const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto v = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), {a, b, c});
  mesh.triangles.push_back({v, v + 1, v + 2});
}

/// Slivers of one length; the first corners are those of the short side or of a long one, which
/// gives grids of all sizes.
TriangleMesh slivers(std::uint64_t seed, std::size_t count, double length, double width,
                     double disorder) {
  std::mt19937_64 engine(seed);
  TriangleMesh mesh;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 a = random_point(engine, 0, 1);
    const Vec3 along = glm::normalize(Vec3(1, 1.1, 0.9) + disorder * random_point(engine, -1, 1));
    const Vec3 b = a + width * random_point(engine, -1, 1);
    i % 2 == seed % 2 ? add(mesh, a, b, a + length * along) : add(mesh, a, a + length * along, b);
  }
  return mesh;
}

void append(TriangleMesh& mesh, const TriangleMesh& more) {
  for (const Triangle& t : more.triangles)
    add(mesh, more.positions[t[0]], more.positions[t[1]], more.positions[t[2]]);
}

/// A slim cylinder along an axis across the coordinate axes, of two slivers per section.
TriangleMesh slim_cylinder(std::uint32_t sections) {
  const Vec3 along = glm::normalize(Vec3(1, 2, 3));
  const Vec3 u = glm::normalize(glm::cross(along, Vec3(1, 0, 0)));
  const Vec3 v = glm::cross(along, u);
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < sections; ++i) {
    const double angle = 6.283185307179586 * i / sections;
    const Vec3 p = 0.1 * (std::cos(angle) * u + std::sin(angle) * v);
    mesh.positions.push_back(p);
    mesh.positions.push_back(p + 10.0 * along);
    const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % sections);
    mesh.triangles.push_back({a, b, a + 1});
    mesh.triangles.push_back({b, b + 1, a + 1});
  }
  return mesh;
}

Pairs all_with_all(const TriangleMesh& mesh) {
  Pairs pairs;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    if (is_degenerate(mesh, mesh.triangles[i])) {
      pairs.emplace_back(i, i);
      continue;
    }
    for (std::uint32_t j = i + 1; j < mesh.triangles.size(); ++j) {
      if (is_degenerate(mesh, mesh.triangles[j])) continue;
      if (overlap(mesh, mesh.triangles[i], mesh.triangles[j])) pairs.emplace_back(i, j);
    }
  }
  return pairs;
}

std::vector<std::array<Vec3, 3>> corners_of(const TriangleMesh& mesh) {
  std::vector<std::array<Vec3, 3>> corners;
  for (const Triangle& t : mesh.triangles)
    corners.push_back({mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]});
  return corners;
}

TEST_CASE("of crowds of slivers exactly the pairs are found that comparing all with all finds") {
  const std::uint64_t seed = GENERATE(1U, 2U);
  const double length = GENERATE(0.05, 0.5, 3.0);
  const double disorder = GENERATE(0.0, 0.1, 5.0);
  CAPTURE(seed, length, disorder);
  TriangleMesh mesh = slivers(seed, 2000, length, 0.01, disorder);
  append(mesh, slivers(seed + 10, 500, 0.01, 0.01, 5.0));
  add(mesh, {0, 0, 0}, {1, 1, 1}, {2, 2, 2});
  const Pairs expected = all_with_all(mesh);
  REQUIRE(expected.size() > 1);
  REQUIRE(self_intersections(mesh) == expected);
}

TEST_CASE("the pairs of crowds of slivers do not depend on where the origin is") {
  TriangleMesh mesh = slivers(5, 3000, 1.0, 0.01, 0.3);
  for (Vec3& p : mesh.positions)
    p += Vec3(3e5, -2e6, 1e5);
  REQUIRE(self_intersections(mesh) == all_with_all(mesh));
}

TEST_CASE("slivers that touch in a corner, along a side or all over are found in a crowd") {
  std::mt19937_64 engine(7);
  TriangleMesh mesh = slivers(7, 1500, 1.0, 1e-3, 0.3);
  for (std::size_t i = 0; i < 1500; i += 2) {
    const Vec3 a = mesh.positions[3 * i], b = mesh.positions[3 * i + 1];
    add(mesh, a, b, random_point(engine, 0, 1));
    add(mesh, b, random_point(engine, 0, 1), random_point(engine, 0, 1));
  }
  append(mesh, slivers(7, 100, 1.0, 1e-3, 0.3));
  REQUIRE(self_intersections(mesh) == all_with_all(mesh));
}

TEST_CASE("of a crowd, pairs with a changed sliver are found when only these are asked for") {
  const TriangleMesh mesh = slivers(8, 6000, 1.0, 0.02, 0.3);
  std::vector<std::uint32_t> changed(3000);
  std::iota(changed.begin(), changed.end(), 100U);
  Pairs expected;
  for (const auto& pair : self_intersections(mesh)) {
    const auto is_changed = [](std::uint32_t i) { return i >= 100 && i < 3100; };
    if (is_changed(pair.first) || is_changed(pair.second)) expected.push_back(pair);
  }
  REQUIRE(expected.size() > 100);
  REQUIRE(self_intersections(mesh, changed) == expected);
}

TEST_CASE("the pairs of a crowd do not depend on the number of threads") {
  const TriangleMesh mesh = slivers(9, 5000, 1.0, 0.02, 1.0);
  Pairs one, four;
  run_with_threads(1, [&] { one = self_intersections(mesh); });
  run_with_threads(4, [&] { four = self_intersections(mesh); });
  REQUIRE(one == four);
}

TEST_CASE("pairs of two triangles that do not ask are not reported, all others are, once") {
  const TriangleMesh mesh = slivers(10, 1000, 1.0, 0.05, 1.0);
  constexpr std::uint32_t kAsking = 300;
  Pairs expected;
  for (const auto& [i, j] : all_with_all(mesh)) {
    if (i < kAsking) expected.emplace_back(i, j);
  }
  const auto is_pair = [&](std::uint32_t i, std::uint32_t j) {
    return overlap(mesh, mesh.triangles[i], mesh.triangles[j]);
  };
  REQUIRE(pairs_in_crowd(corners_of(mesh), kAsking, is_pair) == expected);
  REQUIRE(pairs_in_crowd(corners_of(mesh), 0, is_pair).empty());
}

/// How many pairs are asked for, of all triangles.
std::size_t asked_pairs(const TriangleMesh& mesh) {
  std::atomic<std::size_t> count{0};
  const auto is_pair = [&](std::uint32_t, std::uint32_t) {
    ++count;
    return false;
  };
  REQUIRE(pairs_in_crowd(corners_of(mesh), mesh.triangles.size(), is_pair).empty());
  return count;
}

TEST_CASE("slivers side by side across the axes are compared with few others") {
  constexpr std::uint32_t kSections = 5000;
  const std::size_t asked = asked_pairs(slim_cylinder(kSections));
  REQUIRE(asked > kSections);
  REQUIRE(asked < 20 * kSections);  // all with all: 50 million
  REQUIRE(self_intersections(slim_cylinder(kSections)).empty());
}

TEST_CASE("slivers in all directions are compared with a small part of the others") {
  constexpr std::size_t kCount = 10000;
  REQUIRE(asked_pairs(slivers(11, kCount, 1.0, 1e-4, 5.0)) < kCount * kCount / 2 / 20);
}

}  // namespace
}  // namespace rangezip
