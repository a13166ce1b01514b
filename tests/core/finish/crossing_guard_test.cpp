#include "core/finish/crossing_guard.h"

#include <catch2/catch.hpp>
#include <random>
#include <vector>

#include "core/mesh/self_intersection.h"
#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

using testing::uniform;

constexpr double kSide = 0.4;

/// Vertices in the unit cube.
TriangleMesh scattered_vertices(std::size_t count, std::mt19937_64& engine) {
  TriangleMesh mesh;
  for (std::size_t i = 0; i < count; ++i) {
    mesh.positions.push_back(
        {uniform(engine, 0.0, 1.0), uniform(engine, 0.0, 1.0), uniform(engine, 0.0, 1.0)});
  }
  return mesh;
}

Triangle any_face(std::size_t vertices, std::mt19937_64& engine) {
  const auto any = [&] { return static_cast<std::uint32_t>(engine() % vertices); };
  Triangle t{any(), any(), any()};
  while (t[1] == t[0])
    t[1] = any();
  while (t[2] == t[0] || t[2] == t[1])
    t[2] = any();
  return t;
}

TEST_CASE("a face is refused where and only where the mesh with it would cross itself",
          "[finish]") {
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  TriangleMesh mesh = scattered_vertices(60, engine);
  CrossingGuard guard(mesh, kSide);
  int refused = 0;
  for (int i = 0; i < 400; ++i) {
    const Triangle face = any_face(mesh.positions.size(), engine);
    mesh.triangles.push_back(face);
    const bool crosses = !self_intersections(mesh).empty();
    mesh.triangles.pop_back();
    REQUIRE(guard.would_cross(face) == crosses);
    if (crosses) {
      ++refused;
      continue;
    }
    mesh.triangles.push_back(face);
    guard.add(static_cast<std::uint32_t>(mesh.triangles.size() - 1));
  }
  CHECK(mesh.triangles.size() >= 5);
  CHECK(refused >= 100);
}

TEST_CASE("faces that are there from the beginning are watched, those without area are not",
          "[finish]") {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0},     {1, 0, 0},     {0, 1, 0},      {0.2, 0.2, -1},
                    {0.2, 0.2, 1}, {0.9, 0.9, 1}, {0.2, 0.2, 0.5}};
  mesh.triangles = {{0, 1, 2}, {3, 6, 4}};
  const CrossingGuard guard(mesh, kSide);
  CHECK(guard.would_cross({3, 4, 5}));
  CHECK(guard.would_cross({0, 1, 2}));
  CHECK_FALSE(guard.would_cross({6, 4, 5}));
  CHECK_FALSE(guard.would_cross({1, 0, 3}));
}

}  // namespace
}  // namespace rangezip
