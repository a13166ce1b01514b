// Components face the scanners that saw them: rooms inwards, bodies outwards, sheets to the side
// from which they were measured.

#include <catch2/catch.hpp>
#include <limits>
#include <stop_token>

#include "core/base/error.h"
#include "core/mesh/mesh_report.h"
#include "core/session/turn_to_scanners.h"
#include "raster_cpu/cpu_rasterizer.h"
#include "tests/support/shapes.h"

using namespace rangezip;

namespace {

/// Six times the volume inside, negative where faces look inwards.
double six_volumes(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += glm::dot(mesh.positions[a], glm::cross(mesh.positions[b], mesh.positions[c]));
  return sum;
}

/// A room of half side 3 around the origin, and a ball of radius 0.5 in it; both face outwards.
TriangleMesh room_with_ball(const Vec3& ball) {
  return shapes::to_mesh(shapes::merged(
      shapes::cube(3.0), shapes::moved(shapes::sphere(0.5, 24), shapes::translation(ball))));
}

const double kRoom = six_volumes(shapes::to_mesh(shapes::cube(3.0)));
const double kBall = six_volumes(shapes::to_mesh(shapes::sphere(0.5, 24)));

}  // namespace

TEST_CASE("a room faces the scanner in it, and so does what stands in the room", "[session]") {
  CpuRasterizer rasterizer;
  const Vec3 far = GENERATE(Vec3(0.0), Vec3(4e5, -5e6, 100.0));  // as of a national grid
  TriangleMesh mesh = room_with_ball({1.5, 0.0, 0.0});
  for (Vec3& position : mesh.positions)
    position += far;
  const std::vector<Vec3> before = mesh.positions;
  const Vec3 scanner = far + Vec3{-2.0, 0.5, 0.3};
  CHECK(turn_to_scanners(mesh, rasterizer, {&scanner, 1}) == 1);
  CHECK_NOTHROW(check_mesh(mesh));
  CHECK(mesh.positions == before);
  for (Vec3& position : mesh.positions)
    position -= far;
  CHECK(six_volumes(mesh) == Approx(kBall - kRoom).epsilon(1e-6));
  for (Vec3& position : mesh.positions)
    position += far;
  CHECK(turn_to_scanners(mesh, rasterizer, {&scanner, 1}) == 0);  // as it should be now
}

TEST_CASE("a scanner outside sees fronts, and turns what shows it a back", "[session]") {
  CpuRasterizer rasterizer;
  TriangleMesh mesh = shapes::to_mesh(shapes::torus());
  const TriangleMesh outwards = mesh;
  const std::vector<Vec3> scanners{{4.0, 1.0, 3.0}, {-40.0, 1.0, 2.0}};
  CHECK(turn_to_scanners(mesh, rasterizer, scanners) == 0);
  CHECK(mesh == outwards);
  for (Triangle& face : mesh.triangles)
    std::swap(face[1], face[2]);
  CHECK(turn_to_scanners(mesh, rasterizer, scanners) == 1);
  CHECK(mesh == outwards);
}

TEST_CASE("a sheet faces the side from which it was measured", "[session]") {
  CpuRasterizer rasterizer;
  const double height = GENERATE(-2.0, 2.0);
  TriangleMesh sheet = shapes::square_sheet(8);
  const bool was_up = unit_normal(sheet.positions, sheet.triangles[0]).z > 0.0;
  const Vec3 scanner{0.3, 0.4, height};
  CHECK(turn_to_scanners(sheet, rasterizer, {&scanner, 1}) == (was_up == (height > 0.0) ? 0 : 1));
  for (const Triangle& face : sheet.triangles)
    CHECK(unit_normal(sheet.positions, face).z * height > 0.0);
}

TEST_CASE("what no scanner sees stays, and what shows through a hole does not decide",
          "[session]") {
  CpuRasterizer rasterizer;
  TriangleMesh mesh = room_with_ball({0.0, 0.0, 0.0});
  const TriangleMesh before = mesh;
  const Vec3 outside{9.0, 1.0, 2.0};
  CHECK(turn_to_scanners(mesh, rasterizer, {&outside, 1}) == 0);
  CHECK(mesh == before);

  // Through holes in two shells, one in the other, the scanner sees some of the inner one's inside
  // and nothing of its outside.
  TriangleMesh shells =
      shapes::to_mesh(shapes::merged(shapes::sphere(1.0, 48), shapes::sphere(1.3, 48)));
  std::erase_if(shells.triangles, [&](const Triangle& face) {
    const Vec3 middle = centroid_of(shells.positions, face);
    return middle.x > (glm::length(middle) < 1.15 ? 0.9 : 1.28);
  });
  remove_unused_vertices(shells);
  const TriangleMesh with_holes = shells;
  const Vec3 in_front{10.0, 0.0, 0.0};
  CHECK(turn_to_scanners(shells, rasterizer, {&in_front, 1}) == 0);
  CHECK(shells == with_holes);
}

TEST_CASE("scanners must be somewhere; without any, without faces, or cancelled, nothing is turned",
          "[session]") {
  CpuRasterizer rasterizer;
  TriangleMesh mesh = room_with_ball({1.5, 0.0, 0.0});
  const TriangleMesh before = mesh;
  CHECK(turn_to_scanners(mesh, rasterizer, {}) == 0);
  CHECK(mesh == before);
  const Vec3 nowhere{0.0, std::numeric_limits<double>::quiet_NaN(), 0.0};
  CHECK_THROWS_AS(turn_to_scanners(mesh, rasterizer, {&nowhere, 1}), InvalidArgument);
  const Vec3 scanner{0.0};
  const Vec3 in_room{-2.0, 0.5, 0.3};
  std::stop_source source;
  source.request_stop();
  const Progress cancelled{.stop = source.get_token()};
  CHECK_THROWS_AS(turn_to_scanners(mesh, rasterizer, {&in_room, 1}, cancelled), Cancelled);
  CHECK(mesh == before);
  TriangleMesh empty;
  CHECK(turn_to_scanners(empty, rasterizer, {&scanner, 1}) == 0);
}
