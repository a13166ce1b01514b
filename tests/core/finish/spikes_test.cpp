#include "core/finish/spikes.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

using testing::uniform;

constexpr int kN = 20;
constexpr double kH = 2.0 / kN;
const Box kRegion{Vec3(-2.0), Vec3(2.0)};

std::size_t flatten(TriangleMesh& mesh, const std::vector<Vec3>& points) {
  const CornerTable table(mesh.triangles, mesh.positions.size());
  return flatten_spikes(mesh.positions, table, PointGrid(points, kRegion, 0.7 * kH), kH);
}

/// The square [-1, 1]^2 at z = 0 with one vertex lifted.
TriangleMesh sheet_with_spike(std::size_t& spike, double height) {
  TriangleMesh mesh = testing::cube(kN);
  testing::cut_where(mesh, [](const Vec3& p) { return p.z < 1.0; });
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    mesh.positions[v].z = 0.0;
    if (glm::length(mesh.positions[v]) < 0.1 * kH) spike = v;
  }
  mesh.positions[spike].z = height;
  return mesh;
}

std::vector<Vec3> sheet_points(std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::vector<Vec3> points(static_cast<std::size_t>(9 * kN * kN));
  for (Vec3& p : points)
    p = {uniform(engine, -1, 1), uniform(engine, -1, 1), 0.0};
  return points;
}

TEST_CASE("a vertex at an outlier goes back into the sheet, and no other moves") {
  const std::uint64_t seed = GENERATE(1U, 2U, 3U);
  CAPTURE(seed);
  const double height = GENERATE(0.6, 1.0, -1.5) * kH;
  std::size_t spike = 0;
  TriangleMesh mesh = sheet_with_spike(spike, height);
  std::vector<Vec3> points = sheet_points(seed);
  points.push_back(mesh.positions[spike]);
  TriangleMesh flat = mesh;
  flat.positions[spike].z = 0.0;
  REQUIRE(flatten(mesh, points) == 1);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    // The middle of its neighbours is the middle of the lattice there.
    REQUIRE(glm::length(mesh.positions[v] - flat.positions[v]) < 1e-6);
  }
  REQUIRE(flatten(mesh, points) == 0);
}

TEST_CASE("without points around its foot a spike stays: nothing says where it belongs") {
  std::size_t spike = 0;
  TriangleMesh mesh = sheet_with_spike(spike, kH);
  REQUIRE(flatten(mesh, {}) == 0);
  REQUIRE(flatten(mesh, {mesh.positions[spike]}) == 0);
}

TEST_CASE("a small cone that the points show, and the corners of a cube, are no spikes") {
  std::mt19937_64 engine(7);
  std::size_t tip = 0;
  TriangleMesh mesh = sheet_with_spike(tip, kH);
  std::vector<Vec3> points;
  for (Vec3 p : sheet_points(4)) {
    p.z = std::max(0.0, kH - std::sqrt(p.x * p.x + p.y * p.y));
    points.push_back(p);
  }
  // As dense on the cone as the surface of it asks for.
  for (int i = 0; i < 40; ++i) {
    const Vec3 p{uniform(engine, -kH, kH), uniform(engine, -kH, kH), 0.0};
    points.emplace_back(p.x, p.y, std::max(0.0, kH - std::sqrt(p.x * p.x + p.y * p.y)));
  }
  std::erase_if(points, [](const Vec3& p) { return p.z == 0.0 && glm::length(p) < kH; });
  REQUIRE(flatten(mesh, points) == 0);

  TriangleMesh cube = testing::cube(kN);
  std::vector<Vec3> on_cube;
  for (int i = 0; i < 20000; ++i) {
    Vec3 p{uniform(engine, -1, 1), uniform(engine, -1, 1), uniform(engine, -1, 1)};
    p[i % 3] = i % 2 == 0 ? 1.0 : -1.0;
    on_cube.push_back(p);
  }
  REQUIRE(flatten(cube, on_cube) == 0);
}

}  // namespace
}  // namespace rangezip
