#include "core/finish/fit_vertices.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

/// Mean and mean square over the area of the height of the unit sphere over the faces.
struct Gap {
  double mean = 0.0;
  double mean2 = 0.0;
};

Gap gap_of(const TriangleMesh& mesh) {
  constexpr int kSteps = 6;
  Gap gap;
  double weight = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const double area =
        glm::length(area_vector(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]));
    for (int i = 0; i < kSteps; ++i) {
      for (int j = 0; i + j < kSteps; ++j) {
        const double a = (i + 1.0 / 3.0) / kSteps, b = (j + 1.0 / 3.0) / kSteps;
        const Vec3 p = a * mesh.positions[t[0]] + b * mesh.positions[t[1]] +
                       (1.0 - a - b) * mesh.positions[t[2]];
        const double height = 1.0 - glm::length(p);
        gap.mean += area * height;
        gap.mean2 += area * height * height;
        weight += area;
      }
    }
  }
  return {gap.mean / weight, gap.mean2 / weight};
}

TEST_CASE("faces, not only their corners, come to lie on the surface") {
  constexpr double kH = 0.05;
  std::mt19937_64 engine(1);
  const PointGrid cloud(testing::sphere_points(kH / 2.2, 0.0, engine), {Vec3(-1.5), Vec3(1.5)},
                        0.7 * kH);
  TriangleMesh mesh = testing::sphere(12);
  const Gap before = gap_of(mesh);
  REQUIRE(before.mean > 0.0);
  fit_vertices(mesh, cloud, {{1.3 * kH, kH}, 0.0, {}});
  const Gap after = gap_of(mesh);
  REQUIRE(std::abs(after.mean) < 0.05 * before.mean);
  // Over an equilateral triangle the height is proportional to s = b0 b1 + b1 b2 + b2 b0, whose
  // mean square is 1/15; without its mean, 1/4, it is 1/240: a sixteenth. These are not
  // equilateral.
  REQUIRE(after.mean2 < before.mean2 / 8.0);
}

TEST_CASE("a plane stays a plane, and the boundary stays") {
  TriangleMesh mesh = testing::cube(6);
  testing::cut_where(mesh, [](const Vec3& p) { return p.z < 0.99; });
  std::mt19937_64 engine(2);
  std::vector<Vec3> points(4000);
  for (Vec3& p : points)
    p = {testing::uniform(engine, -1, 1), testing::uniform(engine, -1, 1), 1.0};
  const TriangleMesh before = mesh;
  fit_vertices(mesh, PointGrid(points, {Vec3(-2.0), Vec3(2.0)}, 0.1), {{0.2, 0.2}, 0.0, {}});
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    REQUIRE(glm::length(mesh.positions[v] - before.positions[v]) < 1e-6);
  REQUIRE(mesh.triangles == before.triangles);
}

TEST_CASE("without points nothing moves") {
  TriangleMesh mesh = testing::sphere(6);
  const TriangleMesh before = mesh;
  fit_vertices(mesh, PointGrid({}, {Vec3(-1.0), Vec3(1.0)}, 0.1), {{0.2, 0.2}, 0.0, {}});
  REQUIRE(mesh == before);
}

}  // namespace
}  // namespace rangezip
