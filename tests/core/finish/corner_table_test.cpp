#include "core/finish/corner_table.h"

#include <catch2/catch.hpp>
#include <random>

#include "core/finish/boundary_loops.h"
#include "core/finish/clean_topology.h"
#include "core/finish/components.h"
#include "core/mesh/mesh_report.h"
#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

constexpr std::uint32_t kNone = CornerTable::kNone;

/// Every link is mutual and joins opposite half-edges; every vertex turns over all its faces.
void require_consistent(const CornerTable& table) {
  std::vector<int> faces(table.vertex_count(), 0), visited(table.vertex_count(), 0);
  for (std::uint32_t c = 0; c < table.corner_count(); ++c) {
    if (table.is_deleted(c / 3)) continue;
    ++faces[table.vertex(c)];
    const std::uint32_t d = table.across(c);
    if (d == kNone) continue;
    REQUIRE(table.across(d) == c);
    REQUIRE(table.vertex(d) == table.head(c));
    REQUIRE(table.head(d) == table.vertex(c));
  }
  for (std::uint32_t v = 0; v < table.vertex_count(); ++v) {
    table.for_each_corner(v, [&](std::uint32_t c) {
      REQUIRE(table.vertex(c) == v);
      ++visited[v];
    });
  }
  REQUIRE(faces == visited);
}

TriangleMesh mesh_of(const CornerTable& table) {
  return {std::vector<Vec3>(table.vertex_count(), Vec3{0.0}), table.triangles(), {}};
}

TEST_CASE("random flips, collapses and splits keep the surface manifold and its topology") {
  const std::uint64_t seed = GENERATE(1U, 2U, 3U);
  const bool open = GENERATE(false, true);
  CAPTURE(seed, open);
  TriangleMesh mesh = testing::sphere(6);
  if (open) testing::cut_where(mesh, [](const Vec3& p) { return p.z > 0.7; });
  const std::ptrdiff_t euler = report_mesh(mesh).euler;
  const std::size_t boundary = report_mesh(mesh).boundary_edges;
  CornerTable table(mesh.triangles, mesh.positions.size());
  std::mt19937_64 engine(seed);
  int flips = 0, collapses = 0;
  for (int i = 0; i < 3000; ++i) {
    const auto c = static_cast<std::uint32_t>(engine() % table.corner_count());
    if (table.is_deleted(c / 3)) continue;
    switch (engine() % 3) {
      case 0:
        if (table.is_flip_ok(c)) table.flip(c), ++flips;
        break;
      case 1:
        if (table.is_collapse_ok(c)) table.collapse(c), ++collapses;
        break;
      default:
        if (engine() % 2 == 0) {
          table.split(c / 3);
        } else if (table.across(c) != CornerTable::kNone) {
          const std::uint32_t a = table.vertex(c), b = table.head(c);
          const std::uint32_t middle = table.split_edge(c);
          REQUIRE(table.are_neighbors(middle, a));
          REQUIRE(table.are_neighbors(middle, b));
          REQUIRE_FALSE(table.are_neighbors(a, b));
        }
    }
    if (i % 100 == 0) require_consistent(table);
  }
  require_consistent(table);
  REQUIRE(flips > 100);
  REQUIRE(collapses > 100);
  const MeshReport report = report_mesh(mesh_of(table));
  REQUIRE(report.is_manifold());
  REQUIRE(report.euler == euler);
  REQUIRE(report.boundary_edges == boundary);
}

TEST_CASE("collapses on the boundary take its edges away and keep the topology") {
  const std::uint64_t seed = GENERATE(1U, 2U, 3U);
  CAPTURE(seed);
  TriangleMesh mesh = testing::sphere(6);
  testing::cut_where(mesh, [](const Vec3& p) { return std::abs(p.z) > 0.7; });
  const MeshReport before = report_mesh(mesh);
  CornerTable table(mesh.triangles, mesh.positions.size());
  std::mt19937_64 engine(seed);
  std::size_t collapses = 0;
  for (int i = 0; i < 3000; ++i) {
    const auto c = static_cast<std::uint32_t>(engine() % table.corner_count());
    if (table.is_deleted(c / 3)) continue;
    if (table.is_boundary_collapse_ok(c)) {
      table.collapse_boundary(c);
      ++collapses;
    } else if (engine() % 4 == 0 && table.is_collapse_ok(c)) {
      table.collapse(c);
    }
    if (i % 100 == 0) require_consistent(table);
  }
  require_consistent(table);
  const MeshReport after = report_mesh(mesh_of(table));
  REQUIRE(collapses > 10);
  REQUIRE(after.is_manifold());
  REQUIRE(after.euler == before.euler);
  REQUIRE(after.boundary_edges == before.boundary_edges - collapses);
  REQUIRE(after.boundary_edges >= 6);  // of two loops
}

TEST_CASE("a tetrahedron allows no collapse and no flip") {
  const CornerTable table({{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}, 4);
  for (std::uint32_t c = 0; c < 12; ++c) {
    REQUIRE_FALSE(table.is_collapse_ok(c));
    REQUIRE_FALSE(table.is_flip_ok(c));
  }
}

TEST_CASE("boundary_loops go around in the direction that fills them") {
  TriangleMesh mesh = testing::sphere(8);
  testing::cut_where(mesh, [](const Vec3& p) { return std::abs(p.z) > 0.8; });
  const CornerTable table(mesh.triangles, mesh.positions.size());
  const std::vector<BoundaryLoop> loops = boundary_loops(table);
  REQUIRE(loops.size() == 2);
  std::size_t edges = 0;
  for (const BoundaryLoop& loop : loops) {
    const std::vector<std::uint32_t> v = vertices_of(loop, table);
    edges += v.size();
    double length = 0.0;
    Vec3 area{0.0}, center{0.0};
    for (std::size_t i = 0; i < v.size(); ++i) {
      const Vec3& p = mesh.positions[v[i]];
      const Vec3& q = mesh.positions[v[(i + 1) % v.size()]];
      REQUIRE(table.vertex(loop.corners[i]) == v[(i + 1) % v.size()]);
      REQUIRE(table.across(loop.corners[i]) == kNone);
      length += glm::length(q - p);
      area += glm::cross(p, q);
      center += p;
    }
    REQUIRE(glm::dot(area, center) > 0.0);  // a fill looks outward
    REQUIRE(perimeter_of(loop, table, mesh.positions) == Approx(length).epsilon(1e-12));
  }
  REQUIRE(edges == report_mesh(mesh).boundary_edges);
}

TEST_CASE("components are numbered in order of their first face") {
  TriangleMesh mesh = testing::cube(1);
  const TriangleMesh other = testing::sphere(3);
  const auto shift = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vec3& p : other.positions)
    mesh.positions.push_back(p + Vec3(5, 0, 0));
  for (const Triangle& t : other.triangles) {
    mesh.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  }
  std::vector<std::uint32_t> expected(12, 0);
  expected.resize(mesh.triangles.size(), 1);
  REQUIRE(components_of(CornerTable(mesh.triangles, mesh.positions.size())) == expected);
}

TEST_CASE("clean_topology makes any soup of faces manifold and leaves manifolds alone") {
  TriangleMesh sphere = testing::sphere(5);
  REQUIRE(clean_topology(sphere) == 0);
  REQUIRE(sphere == testing::sphere(5));

  const std::uint64_t seed = GENERATE(1U, 2U, 3U, 4U);
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  TriangleMesh soup;
  soup.positions.resize(200);
  for (int i = 0; i < 400; ++i) {
    soup.triangles.push_back({static_cast<std::uint32_t>(engine() % 200),
                              static_cast<std::uint32_t>(engine() % 200),
                              static_cast<std::uint32_t>(engine() % 200)});
  }
  const std::size_t dropped = clean_topology(soup);
  REQUIRE(dropped + soup.triangles.size() == 400);
  REQUIRE(report_mesh(soup).is_manifold());
  REQUIRE_NOTHROW(check_mesh(soup));
  REQUIRE_FALSE(soup.triangles.empty());
  REQUIRE(clean_topology(soup) == 0);
}

TEST_CASE("of two fans at a vertex the larger one stays") {
  // Four faces on one side of vertex 0, one on the other.
  TriangleMesh mesh{
      std::vector<Vec3>(8, Vec3{0.0}), {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 6, 7}}, {}};
  REQUIRE(clean_topology(mesh) == 1);
  REQUIRE(mesh.triangles.size() == 4);
  REQUIRE(mesh.triangles.back() == Triangle{0, 4, 5});
}

}  // namespace
}  // namespace rangezip
