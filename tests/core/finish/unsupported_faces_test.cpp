#include "core/finish/unsupported_faces.h"

#include <catch2/catch.hpp>
#include <cstddef>
#include <random>

#include "core/mesh/mesh_report.h"
#include "tests/core/finish/bridged_sheets.h"
#include "tests/core/finish/shapes.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

/// Points over two squares of side 6 beside each other, `gap` apart.
std::vector<Vec3> two_squares(double gap) {
  constexpr double kStep = 0.4;
  std::vector<Vec3> points;
  for (int i = 0; i <= 15; ++i) {
    for (int k = 0; k <= 15; ++k) {
      points.emplace_back(-0.5 * gap - kStep * i, kStep * k, 0.0);
      points.emplace_back(0.5 * gap + kStep * i, kStep * k, 0.0);
    }
  }
  return points;
}

/// A strip of that mesh size across both, from x = -5 to 5: its middle column lies over the gap.
TriangleMesh strip(double gap) {
  TriangleMesh mesh;
  for (const double x : {-4.0, -3.0, -2.0, -0.5 * gap, 0.5 * gap, 2.0, 3.0, 4.0}) {
    mesh.positions.emplace_back(x, 2.0, 0.0);
    mesh.positions.emplace_back(x, 3.0, 0.0);
  }
  for (std::uint32_t i = 0; i + 2 < mesh.positions.size(); i += 2) {
    mesh.triangles.push_back({i, i + 2, i + 3});
    mesh.triangles.push_back({i, i + 3, i + 1});
  }
  return mesh;
}

}  // namespace

TEST_CASE("faces across a gap without points go, those on the surface stay", "[finish]") {
  TriangleMesh mesh = strip(2.0);
  CHECK(drop_unsupported_faces(mesh, two_squares(2.0), 1.0) == 2);
  const MeshReport report = report_mesh(mesh);
  CHECK(report.is_manifold());
  CHECK(report.components == 2);
}

TEST_CASE("a gap narrower than the points can tell stays bridged", "[finish]") {
  TriangleMesh mesh = strip(1.0);
  CHECK(drop_unsupported_faces(mesh, two_squares(1.0), 1.0) == 0);
}

TEST_CASE("where points are sparse the limit is their spacing, not the pixel", "[finish]") {
  // Points 1.6 apart: the middles of faces are up to 1.1 from them, and h is 0.5.
  std::vector<Vec3> points;
  for (int i = -8; i <= 8; ++i) {
    for (int k = -8; k <= 8; ++k)
      points.emplace_back(1.6 * i, 1.6 * k, 0.0);
  }
  TriangleMesh mesh = strip(1.0);
  CHECK(drop_unsupported_faces(mesh, points, 1.0 / 3.0) == 0);
}

TEST_CASE("of a body that is sampled at random no face goes", "[finish]") {
  const TriangleSoup ball = shapes::sphere(10.0, 24);  // sides of 1.3
  TriangleMesh mesh = shapes::to_mesh(ball);
  const std::vector<Vec3> points = shapes::to_points(shapes::sampled(ball, 6000));
  CHECK(drop_unsupported_faces(mesh, points, 1.0) <= mesh.triangles.size() / 200);
}

TEST_CASE("two faces that join two bodies through the air go, those on the bodies stay",
          "[finish]") {
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  testing::BridgedSheets sheets = testing::bridged_sheets(4.0, 8, engine);
  REQUIRE(report_mesh(sheets.mesh).components == 1);
  const PointGrid cloud(sheets.points, {Vec3(-10.0), Vec3(10.0)}, 0.7);
  CHECK(drop_faces_in_air(sheets.mesh, cloud, 1.0) == 2);
  CHECK(report_mesh(sheets.mesh).components == 2);
}

TEST_CASE("without points, or faces, nothing is dropped", "[finish]") {
  TriangleMesh mesh = strip(2.0);
  CHECK(drop_unsupported_faces(mesh, {}, 1.0) == 0);
  TriangleMesh nothing;
  CHECK(drop_unsupported_faces(nothing, two_squares(2.0), 1.0) == 0);
  CHECK(drop_faces_in_air(mesh, PointGrid({}, Box{}, 1.0), 1.0) == 0);
}

}  // namespace rangezip
