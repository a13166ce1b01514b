#include "core/finish/repair.h"

#include <catch2/catch.hpp>

#include "core/mesh/mesh_report.h"
#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

TEST_CASE("a repair closes what is open, but for loops that are settled", "[finish]") {
  constexpr int kN = 40;
  const bool is_settled = GENERATE(false, true);
  TriangleMesh mesh = testing::sphere(kN);
  testing::cut_where(mesh, [](const Vec3& p) { return p.z > 0.85; });
  const SettledLoops settled = is_settled ? SettledLoops(mesh) : SettledLoops();
  std::erase_if(mesh.triangles, [&](const Triangle& t) {
    return mesh.positions[t[0]].z < -0.9;  // no vertex goes: they keep their numbers
  });
  REQUIRE(report_mesh(mesh).boundary_loops == 2);
  std::mt19937_64 engine(1);
  const std::vector<Vec3> cloud = testing::sphere_points(0.02, 0.0, engine);
  FinishOptions options;
  options.pixel_size = 2.0 / kN;
  FinishReport report;
  repair(mesh, {}, settled, PointGrid(cloud, Box{Vec3(-2.0), Vec3(2.0)}, 0.7 * options.pixel_size),
         options, report, {});
  CHECK(report.filled_holes == (is_settled ? 1 : 2));
  CHECK(report_mesh(mesh).boundary_loops == (is_settled ? 1 : 0));
  CHECK(report_mesh(mesh).is_manifold());
}

}  // namespace
}  // namespace rangezip
