#include "core/finish/untangle.h"

#include <catch2/catch.hpp>
#include <random>
#include <vector>

#include "core/mesh/self_intersection.h"
#include "tests/core/finish/all_faces.h"
#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

using testing::all_faces;

TEST_CASE("untangle opens folds and leaves the rest as it is") {
  const std::uint64_t seed = GENERATE(1U, 2U, 3U);
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  TriangleMesh mesh = testing::sphere(20);
  const TriangleMesh round = mesh;
  for (Vec3& p : mesh.positions) {  // one vertex in a hundred goes past its neighbours
    if (engine() % 100 == 0) p = glm::normalize(p + 0.25 * testing::direction(engine));
  }
  const std::size_t crossing = self_intersections(mesh).size();
  REQUIRE(crossing > 10);
  const TriangleMesh before = mesh;
  const UntangleReport report = untangle(mesh, all_faces(mesh));
  REQUIRE(report.crossed == crossing);
  REQUIRE(report.left.empty());
  REQUIRE(self_intersections(mesh).empty());
  REQUIRE(mesh.triangles == before.triangles);
  std::size_t same = 0;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    same += mesh.positions[v] == before.positions[v] ? 1 : 0;
  REQUIRE(same > mesh.positions.size() / 2);
}

TEST_CASE("untangle does nothing where nothing crosses") {
  TriangleMesh mesh = testing::sphere(8);
  const TriangleMesh before = mesh;
  REQUIRE(untangle(mesh, all_faces(mesh)).crossed == 0);
  REQUIRE(mesh == before);
}

TEST_CASE("vertices go back only where faces cross, and nothing crosses then") {
  const std::uint64_t seed = GENERATE(1U, 2U, 3U);
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  TriangleMesh mesh = testing::sphere(20);
  const std::vector<Vec3> before = mesh.positions;
  for (Vec3& p : mesh.positions) {  // all a little, one vertex in a hundred past its neighbours
    p += 0.001 * testing::direction(engine);
    if (engine() % 100 == 0) p = glm::normalize(p + 0.25 * testing::direction(engine));
  }
  const std::vector<Vec3> moved = mesh.positions;
  const std::size_t crossing = self_intersections(mesh).size();
  REQUIRE(crossing > 10);
  REQUIRE(take_back_crossing(mesh, before).crossed == crossing);
  REQUIRE(self_intersections(mesh).empty());
  std::size_t still = 0;
  for (std::size_t v = 0; v < before.size(); ++v) {
    REQUIRE((mesh.positions[v] == before[v] || mesh.positions[v] == moved[v]));
    still += mesh.positions[v] == moved[v] ? 1 : 0;
  }
  REQUIRE(still > before.size() / 2);
  REQUIRE(take_back_crossing(mesh, before).crossed == 0);
}

}  // namespace
}  // namespace rangezip
