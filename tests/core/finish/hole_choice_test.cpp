#include "core/finish/hole_choice.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "core/finish/clean_topology.h"
#include "core/mesh/mesh_report.h"
#include "tests/core/finish/shapes.h"
#include "tests/support/shapes.h"

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

/// The two sides of a thin plate around a hole through it, joined by one square in the wall of the
/// hole: one loop, along one side and back along the other.
TriangleMesh plate_around_hole() {
  TriangleMesh mesh = shapes::square_sheet(24);
  testing::cut_where(mesh, [](const Vec3& p) { return std::hypot(p.x, p.y) < 6.0; });
  const auto count = static_cast<std::uint32_t>(mesh.positions.size());
  const CornerTable table(mesh.triangles, count);
  const std::vector<std::uint32_t> corners = boundary_loops(table).at(1).corners;
  const std::uint32_t a = table.head(corners[0]), b = table.vertex(corners[0]);
  const std::vector<Triangle> faces = mesh.triangles;
  for (std::uint32_t v = 0; v < count; ++v)
    mesh.positions.push_back(mesh.positions[v] - Vec3(0.0, 0.0, 1.0));
  for (const Triangle& t : faces)
    mesh.triangles.push_back({count + t[0], count + t[2], count + t[1]});
  mesh.triangles.push_back({a, b, count + b});
  mesh.triangles.push_back({a, count + b, count + a});
  return mesh;
}

}  // namespace

TEST_CASE("a ragged crack along the edge of a hole is closed along it, not by lids", "[finish]") {
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  int narrow = 0;
  for (int k = 0; k < 20; ++k) {
    TriangleMesh mesh = plate_around_hole();
    const CornerTable table(mesh.triangles, mesh.positions.size());
    std::vector<BoundaryLoop> loops = boundary_loops(table);
    std::erase_if(loops, [&](const BoundaryLoop& loop) {
      const Vec3& p = mesh.positions[table.vertex(loop.corners[0])];
      return std::hypot(p.x, p.y) > 10.0;
    });
    REQUIRE(loops.size() == 1);
    for (const std::uint32_t v : vertices_of(loops[0], table)) {
      for (int i = 0; i < 3; ++i)
        mesh.positions[v][i] += testing::uniform(engine, -0.4, 0.4);
    }
    const PointGrid no_points({}, Box{}, 1.0);
    const auto choice =
        choose_fill(mesh.positions, table, loops[0], FaceTree(mesh.positions, table), 1000.0, false,
                    no_points, {.pixel_size = 1.0});
    REQUIRE(choice);
    if (choice->shape != FillShape::narrow) {
      CHECK(choice->shape == FillShape::flat);
      continue;
    }
    ++narrow;
    CHECK(choice->fill.triangles.size() == loops[0].corners.size() - 2);
    for (const Triangle& t : choice->fill.triangles) {
      for (const std::uint32_t v : t)
        CHECK(glm::distance(mesh.positions[v], mesh.positions[t[0]]) < 4.0);
    }
  }
  CHECK(narrow > 0);
}

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
  const FaceTree faces(mesh.positions, table);
  const PointGrid no_points({}, Box{}, kH);
  const auto choice = [&](double sheet_area, bool has_narrow_gaps = false) {
    return choose_fill(mesh.positions, table, loop, faces, sheet_area, false, no_points,
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
  const FaceTree faces(mesh.positions, table);
  const PointGrid no_points({}, Box{}, kH);
  double area = 0.0;
  for (const Triangle& t : mesh.triangles)
    area += area_of_face(mesh.positions, t);
  const auto is_closed = [&](double sheet_area, bool open_sheet) {
    return choose_fill(mesh.positions, table, loop, faces, sheet_area, false, no_points,
                       {.pixel_size = kH, .open_sheet = open_sheet})
        .has_value();
  };
  CHECK(is_closed(area, false));
  CHECK_FALSE(is_closed(area, true));
  CHECK(is_closed(2.0 * area, true));  // of something larger it is a hole
}

}  // namespace rangezip
