#include "core/finish/hole_choice.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <optional>
#include <vector>

#include "core/finish/clean_topology.h"
#include "core/mesh/mesh_report.h"
#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

constexpr int kN = 40;
constexpr double kH = 2.0 / kN;

/// A long hole in the top of a sphere.
TriangleMesh sphere_with_slot() {
  TriangleMesh mesh = testing::sphere(kN);
  testing::cut_where(
      mesh, [](const Vec3& p) { return p.z > 0.0 && std::abs(p.x) < 0.5 && std::abs(p.y) < kH; });
  clean_topology(mesh);
  return mesh;
}

/// Bends the surface around its only loop up and back over itself, by a pixel.
void add_lip(TriangleMesh& mesh) {
  const CornerTable table(mesh.triangles, mesh.positions.size());
  const std::vector<std::uint32_t> rim = vertices_of(boundary_loops(table).at(0), table);
  const auto n = static_cast<std::uint32_t>(rim.size());
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const std::uint32_t v : rim) {
    const Vec3 p = mesh.positions[v];
    const Vec3 nearest{std::clamp(p.x, -0.5, 0.5), 0.0, p.z};  // on the axis of the slot
    mesh.positions.push_back(p + kH * unit_or_z(p - nearest) + Vec3(0.0, 0.0, 0.3 * kH));
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t k = (i + 1) % n;
    mesh.triangles.push_back({rim[i], rim[k], first + i});
    mesh.triangles.push_back({rim[k], first + k, first + i});
  }
}

}  // namespace

TEST_CASE(
    "a loop over which a fill would fold back is an outline, unless it is short and of a body",
    "[finish]") {
  TriangleMesh mesh = sphere_with_slot();
  add_lip(mesh);
  const MeshReport report = report_mesh(mesh);
  REQUIRE(report.is_manifold());
  REQUIRE(report.longest_loop > 30.0 * kH);
  REQUIRE(report.longest_loop < 60.0 * kH);
  const CornerTable table(mesh.triangles, mesh.positions.size());
  const BoundaryLoop loop = boundary_loops(table).at(0);
  const PointGrid no_points({}, Box{}, kH);
  const auto choice = [&](double sheet_area, bool has_narrow_gaps = false) {
    return choose_fill(mesh.positions, table, loop, sheet_area, false, no_points,
                       {.pixel_size = kH, .has_narrow_gaps = has_narrow_gaps});
  };
  const double as_disc = report.longest_loop * report.longest_loop / (4.0 * 3.14159265358979);
  CHECK_FALSE(choice(9.0 * as_disc));
  REQUIRE(choice(11.0 * as_disc));
  CHECK(choice(11.0 * as_disc)->shape == FillShape::zipped);
  CHECK_FALSE(choice(11.0 * as_disc, true));
}

TEST_CASE("the outline of a small piece is a hole, unless all is seen from one side", "[finish]") {
  TriangleMesh mesh = testing::sphere(kN);
  testing::cut_where(mesh, [](const Vec3& p) { return p.z < 0.0 || std::hypot(p.x, p.y) > 0.13; });
  clean_topology(mesh);
  REQUIRE(report_mesh(mesh).longest_loop < 20.0 * kH);
  const CornerTable table(mesh.triangles, mesh.positions.size());
  const BoundaryLoop loop = boundary_loops(table).at(0);
  const PointGrid no_points({}, Box{}, kH);
  double area = 0.0;
  for (const Triangle& t : mesh.triangles)
    area += area_of_face(mesh.positions, t);
  const auto is_closed = [&](double sheet_area, bool open_sheet) {
    return choose_fill(mesh.positions, table, loop, sheet_area, false, no_points,
                       {.pixel_size = kH, .open_sheet = open_sheet})
        .has_value();
  };
  CHECK(is_closed(area, false));
  CHECK_FALSE(is_closed(area, true));
  CHECK(is_closed(2.0 * area, true));  // of something larger it is a hole
}

}  // namespace rangezip
