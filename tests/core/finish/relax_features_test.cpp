#include "core/finish/relax_features.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "core/finish/triangle_shape.h"
#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

constexpr int kN = 12;
constexpr double kEdge = 2.0 / kN;

bool is_on(double coordinate) {
  return std::abs(std::abs(coordinate) - 1.0) < 1e-9;
}

int planes_through(const Vec3& p) {
  return int(is_on(p.x)) + int(is_on(p.y)) + int(is_on(p.z));
}

/// A cube whose vertices slid within their sides and along its edges.
TriangleMesh disturbed_cube(std::uint64_t seed) {
  TriangleMesh mesh = testing::cube(kN);
  std::mt19937_64 engine(seed);
  for (Vec3& p : mesh.positions) {
    const Vec3 before = p;
    for (int axis = 0; axis < 3; ++axis) {
      if (!is_on(before[axis])) p[axis] += 0.3 * kEdge * testing::uniform(engine, -1, 1);
    }
  }
  return mesh;
}

double smallest_angle(const TriangleMesh& mesh, std::size_t face) {
  const Triangle& t = mesh.triangles[face];
  return sine_of_smallest_angle(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
}

double smallest_angle(const TriangleMesh& mesh) {
  double smallest = 1.0;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
    smallest = std::min(smallest, smallest_angle(mesh, f));
  return smallest;
}

/// Faces at the edges of the cube with an angle under 30 degrees.
std::size_t sharp_faces(const TriangleMesh& mesh) {
  std::size_t count = 0;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const Triangle& t = mesh.triangles[f];
    const bool is_at_edge = std::any_of(
        t.begin(), t.end(), [&](std::uint32_t v) { return planes_through(mesh.positions[v]) > 1; });
    count += is_at_edge && smallest_angle(mesh, f) < 0.5 ? 1 : 0;
  }
  return count;
}

TriangleMesh relaxed(TriangleMesh mesh) {
  std::vector<std::uint8_t> is_feature;
  std::vector<Vec3> before = mesh.positions;
  for (const Vec3& p : before)
    is_feature.push_back(static_cast<std::uint8_t>(planes_through(p) - 1));
  const VertexSides sides{
      .place_on = [&](std::uint32_t v, const Vec3& target) -> std::optional<Vec3> {
        Vec3 place = target;
        for (int axis = 0; axis < 3; ++axis) {
          if (is_on(before[v][axis])) place[axis] = before[v][axis];
        }
        return place;
      },
      .may_change = [](std::uint32_t) { return true; },
      .may_face =
          [&](std::uint32_t v, const Vec3& direction) {
            for (int axis = 0; axis < 3; ++axis) {
              if (is_on(before[v][axis]) &&
                  before[v][axis] * direction[axis] > 0.5 * glm::length(direction))
                return true;
            }
            return false;
          }};
  CornerTable table(mesh.triangles, mesh.positions.size());
  relax_features(table, mesh.positions, is_feature, sides);
  mesh.triangles = table.triangles();
  return mesh;
}

TEST_CASE("relaxing leaves a cube a cube and makes its small angles larger") {
  const std::uint64_t seed = GENERATE(1U, 2U, 3U);
  CAPTURE(seed);
  const TriangleMesh cube = disturbed_cube(seed);
  const TriangleMesh result = relaxed(cube);
  REQUIRE(sharp_faces(cube) > 50);
  REQUIRE(sharp_faces(result) < sharp_faces(cube) / 8);
  REQUIRE(smallest_angle(result) >= smallest_angle(cube));
  REQUIRE(testing::volume_of(result) == Approx(8.0).epsilon(1e-12));
  for (std::size_t v = 0; v < cube.positions.size(); ++v) {
    CAPTURE(v);
    REQUIRE(planes_through(result.positions[v]) == planes_through(cube.positions[v]));
    if (planes_through(cube.positions[v]) == 3) REQUIRE(result.positions[v] == cube.positions[v]);
  }
}

TEST_CASE("a fold beside an edge opens") {
  TriangleMesh mesh = testing::cube(kN);
  // A vertex of the top one row from an edge moves past its neighbour.
  const auto folded = std::find_if(mesh.positions.begin(), mesh.positions.end(), [](const Vec3& p) {
    return is_on(p.z) && std::abs(p.x - (1.0 - kEdge)) < 1e-9 && std::abs(p.y) < 1e-9;
  });
  REQUIRE(folded != mesh.positions.end());
  folded->x -= 1.3 * kEdge;
  const TriangleMesh result = relaxed(mesh);
  REQUIRE(testing::volume_of(result) == Approx(8.0).epsilon(1e-12));
  const auto looks_out = [&](const Triangle& t) {
    const Vec3 a = result.positions[t[0]], b = result.positions[t[1]], c = result.positions[t[2]];
    return glm::dot(area_vector(a, b, c), a + b + c) > 0.0;
  };
  REQUIRE(std::all_of(result.triangles.begin(), result.triangles.end(), looks_out));
}

}  // namespace
}  // namespace rangezip
