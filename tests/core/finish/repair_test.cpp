#include "core/finish/repair.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "core/mesh/mesh_report.h"
#include "core/mesh/self_intersection.h"
#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

constexpr int kN = 40;
constexpr double kH = 2.0 / kN;

PointGrid grid_of(const std::vector<Vec3>& points) {
  return PointGrid(points, Box{Vec3(-2.0), Vec3(2.0)}, 0.7 * kH);
}

/// Of the unit sphere.
std::vector<Vec3> sampled_sphere() {
  std::mt19937_64 engine(1);
  return testing::sphere_points(0.02, 0.0, engine);
}

bool is_cap(const Vec3& p) {
  return p.z > 0.85;
}

TEST_CASE("a repair closes what is open, but for loops that are settled", "[finish]") {
  const bool is_settled = GENERATE(false, true);
  TriangleMesh mesh = testing::sphere(kN);
  testing::cut_where(mesh, is_cap);
  const SettledLoops settled = is_settled ? SettledLoops(mesh) : SettledLoops();
  std::erase_if(mesh.triangles, [&](const Triangle& t) {
    return mesh.positions[t[0]].z < -0.9;  // no vertex goes: they keep their numbers
  });
  REQUIRE(report_mesh(mesh).boundary_loops == 2);
  FinishOptions options;
  options.pixel_size = kH;
  FinishReport report;
  repair(mesh, {}, settled, grid_of(sampled_sphere()), options, report, {});
  CHECK(report.filled_holes == (is_settled ? 1 : 2));
  CHECK(report_mesh(mesh).boundary_loops == (is_settled ? 1 : 0));
  CHECK(report_mesh(mesh).is_manifold());
}

TEST_CASE("open loops are zipped along their cracks; what was not sampled stays, and all faces",
          "[finish]") {
  TriangleMesh mesh = testing::sphere(kN);
  testing::cut_where(mesh, is_cap);
  const double rim = report_mesh(mesh).longest_loop;
  testing::cut_where(mesh, [](const Vec3& p) { return std::abs(p.y) < 0.3 * kH && p.x > 0.2; });
  REQUIRE(report_mesh(mesh).boundary_loops == 1);
  REQUIRE(report_mesh(mesh).longest_loop > rim + 1.0);  // down one side of the crack, up the other
  std::vector<Vec3> cloud = sampled_sphere();
  std::erase_if(cloud, is_cap);
  const std::vector<Triangle> before = mesh.triangles;
  FinishOptions options;
  options.pixel_size = kH;
  FinishReport report;
  zip_open_loops(mesh, grid_of(cloud), options, report);
  CHECK(report.filled_faces == mesh.triangles.size() - before.size());
  CHECK(std::equal(before.begin(), before.end(), mesh.triangles.begin()));
  CHECK(report_mesh(mesh).is_manifold());
  CHECK(self_intersections(mesh).empty());
  CHECK(report_mesh(mesh).boundary_loops == 1);
  CHECK(report_mesh(mesh).longest_loop < rim + 6.0 * kH);
}

TEST_CASE("a crumb that was closed beside the surface is dropped, and counted, once all is zipped",
          "[finish]") {
  TriangleMesh mesh = testing::sphere(kN);
  const TriangleMesh whole = mesh;
  const TriangleMesh crumb = testing::cube(2);
  REQUIRE(crumb.triangles.size() < FinishOptions{}.min_component);
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vec3& p : crumb.positions)
    mesh.positions.push_back(0.5 * kH * p + Vec3(0.0, 0.0, 0.9));
  for (const auto& [a, b, c] : crumb.triangles)
    mesh.triangles.push_back({first + a, first + b, first + c});
  FinishOptions options;
  options.pixel_size = kH;
  FinishReport report;
  zip_open_loops(mesh, grid_of(sampled_sphere()), options, report);
  CHECK(report.dropped_components == 1);
  CHECK(report.dropped_faces == crumb.triangles.size());
  CHECK(mesh == whole);
}

}  // namespace
}  // namespace rangezip
