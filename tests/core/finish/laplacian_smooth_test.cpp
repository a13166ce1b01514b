#include "core/finish/laplacian_smooth.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <stop_token>

#include "core/base/error.h"
#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

TEST_CASE("smoothing shrinks a sphere and keeps its centre") {
  // The lattice is symmetric, so the centre of all vertices cannot move but by rounding.
  const TriangleMesh before = testing::sphere(10);
  const TriangleMesh after = laplacian_smooth(before, 5);
  REQUIRE(after.triangles == before.triangles);
  REQUIRE(testing::volume_of(after) < testing::volume_of(before));
  REQUIRE(testing::volume_of(after) > 0.8 * testing::volume_of(before));
  for (const Vec3& p : after.positions)
    REQUIRE(glm::length(p) < 1.0);
}

TEST_CASE("smoothing removes noise") {
  std::mt19937_64 engine(1);
  TriangleMesh mesh = testing::sphere(20);
  for (Vec3& p : mesh.positions)
    p *= 1.0 + testing::uniform(engine, -0.02, 0.02);
  const auto roughness = [](const TriangleMesh& m) {
    double mean = 0.0, square = 0.0;
    for (const Vec3& p : m.positions)
      mean += glm::length(p);
    mean /= static_cast<double>(m.positions.size());
    for (const Vec3& p : m.positions)
      square += (glm::length(p) - mean) * (glm::length(p) - mean);
    return std::sqrt(square / static_cast<double>(m.positions.size()));
  };
  REQUIRE(roughness(laplacian_smooth(mesh, 3)) < 0.5 * roughness(mesh));
}

TEST_CASE("the boundary stays where it is, and so does a plane") {
  TriangleMesh mesh = testing::cube(8);
  testing::cut_where(mesh, [](const Vec3& p) { return p.z > -0.99; });  // only the bottom is left
  const TriangleMesh after = laplacian_smooth(mesh, 4, 1.0);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3& p = mesh.positions[i];
    REQUIRE(after.positions[i].z == p.z);
    const bool on_border = std::max(std::abs(p.x), std::abs(p.y)) > 0.99;
    if (on_border) REQUIRE(after.positions[i] == p);
  }
}

TEST_CASE("no iterations change nothing") {
  REQUIRE(laplacian_smooth(testing::sphere(4), 0) == testing::sphere(4));
}

TEST_CASE("laplacian_smooth refuses what it cannot do") {
  const TriangleMesh mesh = testing::sphere(2);
  REQUIRE_THROWS_AS(laplacian_smooth(mesh, -1), InvalidArgument);
  REQUIRE_THROWS_AS(laplacian_smooth(mesh, 1, 0.0), InvalidArgument);
  REQUIRE_THROWS_AS(laplacian_smooth(mesh, 1, 1.5), InvalidArgument);
  std::stop_source source;
  source.request_stop();
  REQUIRE_THROWS_AS(laplacian_smooth(mesh, 1, 0.5, {.stop = source.get_token()}), Cancelled);
  REQUIRE_THROWS_AS(laplacian_smooth(mesh, 1, std::numeric_limits<double>::quiet_NaN()),
                    InvalidArgument);
  TriangleMesh broken = mesh;
  broken.triangles.push_back(broken.triangles.front());
  REQUIRE_THROWS_AS(laplacian_smooth(broken, 1), TopologyError);
}

}  // namespace
}  // namespace rangezip
