#include "core/finish/restart_fronts.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "core/finish/boundary_loops.h"
#include "core/finish/clean_topology.h"
#include "core/finish/corner_table.h"
#include "core/mesh/coverage.h"
#include "core/mesh/mesh_report.h"
#include "core/mesh/self_intersection.h"
#include "tests/core/finish/shapes.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

using testing::uniform;

constexpr double kH = 1.0;
constexpr double kOffMesh = 0.42 * kH;
constexpr std::size_t kRagged = 5;
constexpr int kRings = 5;           ///< of vertices of the wall of a hole, at both of its ends
constexpr double kGap = 16.0 * kH;  ///< between them
const GrowOverOptions kSparse{.pixel_size = kH, .off_mesh = kOffMesh, .void_radius = 1.0};

PointGrid grid_of(const std::vector<Vec3>& points) {
  return PointGrid(points, Box{Vec3(-20.0 * kH), Vec3(20.0 * kH)}, kH);
}

/// Around the square of 2 x 2 pixels, from 0 to 8.
Vec3 on_wall(double around, double z) {
  const double along = std::fmod(around, 2.0) - 1.0;
  switch (static_cast<int>(around) / 2 % 4) {
    case 0:
      return {along, -1.0, z};
    case 1:
      return {1.0, along, z};
    case 2:
      return {-along, 1.0, z};
    default:
      return {-1.0, -along, z};
  }
}

/// The wall of a square hole 2 pixels wide, which looks at its axis, without its middle.
TriangleMesh ends_of_hole() {
  constexpr std::uint32_t kAround = 8;
  TriangleMesh mesh;
  for (const double first : {0.0, kRings - 1.0 + kGap}) {
    for (std::uint32_t ring = 0; ring < kRings; ++ring) {
      for (std::uint32_t i = 0; i < kAround; ++i) {
        const auto a = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.push_back(on_wall(i, first + ring));
        if (ring == 0) continue;
        const std::uint32_t b = i + 1 == kAround ? a + 1 - kAround : a + 1;
        mesh.triangles.push_back({a - kAround, a, b - kAround});
        mesh.triangles.push_back({a, b, b - kAround});
      }
    }
  }
  return mesh;
}

/// 1.7 a square pixel on the middle of the wall, thrown at random.
std::vector<Vec3> points_of_gap(std::mt19937_64& engine) {
  std::vector<Vec3> points;
  for (int i = 0; i < static_cast<int>(1.7 * 8.0 * kGap); ++i)
    points.push_back(on_wall(uniform(engine, 0.0, 8.0), kRings - 1.0 + uniform(engine, 0.0, kGap)));
  return points;
}

/// Sum of the squared lengths of boundary loops of five edges or more, the two ends of the hole
/// left out.
double ragged_border(TriangleMesh mesh) {
  clean_topology(mesh);
  const CornerTable table(mesh.triangles, mesh.positions.size());
  double sum = 0.0;
  for (const BoundaryLoop& loop : boundary_loops(table)) {
    const double z = mesh.positions[table.vertex(loop.corners[0])].z;
    const bool is_end = z == 0.0 || z == 2.0 * (kRings - 1) + kGap;
    if (is_end || loop.corners.size() < kRagged) continue;
    const double perimeter = perimeter_of(loop, table, mesh.positions);
    sum += perimeter * perimeter;
  }
  return sum;
}

/// Whether no face leads across the hole.
bool is_off_axis(const TriangleMesh& mesh) {
  return std::none_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
    const Vec3 center = centroid_of(mesh.positions, t);
    return std::max(std::abs(center.x), std::abs(center.y)) < 0.3;
  });
}

TEST_CASE("fronts that start again leave less open in holes two pixels wide, and show all points",
          "[finish]") {
  constexpr std::uint64_t kSeeds = 100;
  double stuck = 0.0, left = 0.0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    CAPTURE(seed);
    std::mt19937_64 engine(seed);
    const std::vector<Vec3> points = points_of_gap(engine);
    TriangleMesh mesh = ends_of_hole();
    grow_over(mesh, points, kSparse);
    const double before = ragged_border(mesh);
    const std::size_t missing = points_off(points, mesh, kOffMesh).size();

    restart_fronts(mesh, points, grid_of(points), kSparse);
    const double after = ragged_border(mesh);
    CHECK(after <= before);
    CHECK(points_off(points, mesh, kOffMesh).size() <= missing);
    clean_topology(mesh);
    CHECK(report_mesh(mesh).is_manifold());
    CHECK(self_intersections(mesh).empty());
    CHECK(is_off_axis(mesh));
    stuck += before;
    left += after;
  }
  CHECK(stuck > 0.0);
  CHECK(2.0 * left < stuck);
}

TEST_CASE("fronts that start again leave the border of a hole without points as it is",
          "[finish]") {
  TriangleMesh mesh = shapes::square_sheet(16);
  testing::cut_where(mesh, [](const Vec3& p) { return glm::length(p) < 4.0; });
  const TriangleMesh before = mesh;
  std::vector<Vec3> points;
  for (const Triangle& t : mesh.triangles)
    points.push_back(centroid_of(mesh.positions, t));
  CHECK(restart_fronts(mesh, points, grid_of(points), kSparse) == 0);
  CHECK(mesh.triangles == before.triangles);
  CHECK(mesh.positions == before.positions);
}

}  // namespace
}  // namespace rangezip
