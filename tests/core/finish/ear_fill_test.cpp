#include "core/finish/ear_fill.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "core/mesh/mesh_report.h"
#include "core/mesh/self_intersection.h"
#include "tests/core/finish/shapes.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

using testing::uniform;

constexpr double kH = 1.0;
constexpr std::uint32_t kSide = 24;

double area_of(const TriangleMesh& mesh) {
  double area = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    area += 0.5 * glm::length(glm::cross(mesh.positions[b] - mesh.positions[a],
                                         mesh.positions[c] - mesh.positions[a]));
  }
  return area;
}

/// The loops of a sheet without its outline, which is the longest.
std::vector<BoundaryLoop> holes_of(const TriangleMesh& mesh, const CornerTable& table) {
  std::vector<BoundaryLoop> loops = boundary_loops(table);
  const auto length = [&](const BoundaryLoop& loop) {
    return perimeter_of(loop, table, mesh.positions);
  };
  loops.erase(std::max_element(
      loops.begin(), loops.end(),
      [&](const BoundaryLoop& a, const BoundaryLoop& b) { return length(a) < length(b); }));
  return loops;
}

/// A flat sheet with a ragged slit along y.
TriangleMesh slit_sheet(std::mt19937_64& engine) {
  TriangleMesh mesh = shapes::square_sheet(kSide);
  std::vector<double> reach(kSide + 1);
  for (double& r : reach)
    r = uniform(engine, 0.8, 1.8);
  for (Vec3& p : mesh.positions) {  // no three in a row
    if (std::max(std::abs(p.x), std::abs(p.y)) < 0.5 * kSide - 0.5)
      p += Vec3{uniform(engine, -0.1, 0.1), uniform(engine, -0.1, 0.1), 0.0};
  }
  testing::cut_where(mesh, [&](const Vec3& p) {
    const auto row = static_cast<std::size_t>(std::lround(p.y + 0.5 * kSide));
    return std::abs(p.y) < 8.5 && std::abs(p.x) < reach[std::min<std::size_t>(row, kSide)];
  });
  return mesh;
}

void require_clean(const TriangleMesh& mesh) {
  REQUIRE(report_mesh(mesh).is_manifold());
  REQUIRE(self_intersections(mesh).empty());
}

}  // namespace

TEST_CASE("ears close a slit in a plane with the area that it has", "[finish]") {
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  TriangleMesh mesh = slit_sheet(engine);
  const CornerTable table(mesh.triangles, mesh.positions.size());
  const EarFills fills = fill_by_ears(mesh, table, holes_of(mesh, table), kH);
  CHECK(fills.left.empty());
  CHECK(fills.faces > 30);
  require_clean(mesh);
  CHECK(area_of(mesh) == Approx(static_cast<double>(kSide * kSide)));
  CHECK(report_mesh(mesh).boundary_loops == 1);
}

TEST_CASE("ears close a ragged slit along the edge of a blade without crossing", "[finish]") {
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  const double degrees = GENERATE(20.0, 40.0, 90.0);
  CAPTURE(seed, degrees);
  std::mt19937_64 engine(seed);
  TriangleMesh mesh = slit_sheet(engine);
  const double half = degrees / 2.0 * 3.14159265358979 / 180.0;
  for (Vec3& p : mesh.positions)  // folded along x = 0
    p = Vec3(-std::abs(p.x) * std::cos(half), p.y, -p.x * std::sin(half));
  const CornerTable table(mesh.triangles, mesh.positions.size());
  fill_by_ears(mesh, table, holes_of(mesh, table), kH);
  require_clean(mesh);
  CHECK(report_mesh(mesh).boundary_loops == 1);
}

TEST_CASE("ears leave open what something else sticks through", "[finish]") {
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  TriangleMesh mesh = slit_sheet(engine);
  const CornerTable hole_table(mesh.triangles, mesh.positions.size());
  const std::vector<BoundaryLoop> holes = holes_of(mesh, hole_table);
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(),
                        {{0.0, -5.0, -3.0}, {0.1, -5.0, 3.0}, {0.0, 5.0, 0.0}});
  mesh.triangles.push_back({first, first + 1, first + 2});
  const CornerTable table(mesh.triangles, mesh.positions.size());
  const EarFills fills = fill_by_ears(mesh, table, holes, kH);
  CHECK(fills.faces > 0);
  CHECK(fills.left.size() >= 3);
  require_clean(mesh);
}

}  // namespace rangezip
