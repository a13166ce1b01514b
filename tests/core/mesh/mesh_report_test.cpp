#include "core/mesh/mesh_report.h"

#include <limits>

#include <catch2/catch.hpp>

#include "core/base/error.h"
#include "core/mesh/self_intersection.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

TriangleMesh mesh_of(std::vector<Vec3> positions, std::vector<Triangle> triangles) {
  return {.positions = std::move(positions), .triangles = std::move(triangles), .sources = {}};
}

/// Triangles that share the vertex 0 and nothing else.
TriangleMesh bow_tie() {
  return mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}},
                 {{0, 1, 2}, {0, 3, 4}});
}

/// Three triangles around the edge (0, 1), the second turned so that no directed edge repeats
/// within the first two.
TriangleMesh book() {
  return mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}},
                 {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
}

TEST_CASE("report_mesh counts closed bodies by Euler's formula", "[mesh]") {
  const MeshReport sphere = report_mesh(shapes::to_mesh(shapes::sphere(1.0, 24)));
  CHECK(sphere.euler == 2);
  CHECK(sphere.components == 1);
  CHECK(sphere.boundary_edges == 0);
  CHECK(sphere.boundary_loops == 0);
  CHECK(sphere.longest_loop == 0.0);
  CHECK(2 * sphere.edges == 3 * sphere.faces);
  CHECK(sphere.is_manifold());

  const MeshReport torus = report_mesh(shapes::to_mesh(shapes::torus(1.0, 0.4, 32)));
  CHECK(torus.euler == 0);
  CHECK(torus.is_manifold());

  const MeshReport two = report_mesh(shapes::to_mesh(shapes::two_spheres(0.5, 12)));
  CHECK(two.euler == 4);
  CHECK(two.components == 2);
}

TEST_CASE("report_mesh measures the boundary", "[mesh]") {
  const int rings = 16;
  const MeshReport bowl = report_mesh(shapes::to_mesh(shapes::bowl(1.0, rings)));
  CHECK(bowl.euler == 1);
  CHECK(bowl.boundary_loops == 1);
  CHECK(bowl.boundary_edges == 4 * rings);
  // The rim is a regular polygon of radius 1, its corners rounded to float.
  const double rim = 4 * rings * 2.0 * std::sin(std::numbers::pi / (4 * rings));
  CHECK(bowl.longest_loop == Approx(rim).epsilon(1e-6));
  CHECK(bowl.is_manifold());
}

TEST_CASE("report_mesh finds every kind of defect", "[mesh]") {
  const MeshReport tie = report_mesh(bow_tie());
  CHECK(tie.nonmanifold_vertices == 1);
  CHECK(tie.components == 2);
  CHECK(tie.boundary_loops == 2);
  CHECK_FALSE(tie.is_manifold());

  const MeshReport book_report = report_mesh(book());
  CHECK(book_report.nonmanifold_edges == 1);
  CHECK(book_report.edges == 7);
  CHECK_FALSE(book_report.is_manifold());

  const MeshReport turned =
      report_mesh(mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 3, 2}}));
  CHECK(turned.misoriented_edges == 1);
  CHECK(turned.nonmanifold_vertices == 0);
  CHECK(turned.boundary_loops == 1);
  CHECK(turned.longest_loop == 4.0);
  CHECK_FALSE(turned.is_manifold());

  const MeshReport flat = report_mesh(
      mesh_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 1, 1}, {0, 1, 3}}));
  CHECK(flat.degenerate_faces == 2);
  CHECK(flat.faces == 3);
}

TEST_CASE("report_mesh does not count unused vertices", "[mesh]") {
  TriangleMesh mesh = shapes::to_mesh(shapes::cube());
  mesh.positions.emplace_back(9.0, 9.0, 9.0);
  const MeshReport report = report_mesh(mesh);
  CHECK(report.vertices == 8);
  CHECK(report.euler == 2);
  CHECK(report_mesh(TriangleMesh{}).euler == 0);
}

TEST_CASE("check_mesh accepts manifold meshes and names each broken rule", "[mesh]") {
  CHECK_NOTHROW(check_mesh(shapes::to_mesh(shapes::washer())));
  CHECK_NOTHROW(check_mesh(shapes::to_mesh(shapes::bowl(1.0, 6))));
  CHECK_NOTHROW(check_mesh(TriangleMesh{}));

  using Catch::Matchers::Contains;
  TriangleMesh mesh = shapes::to_mesh(shapes::cube());
  mesh.triangles[3][1] = 8;
  CHECK_THROWS_WITH(check_mesh(mesh), Contains("face 3 has corner 8"));

  mesh = shapes::to_mesh(shapes::cube());
  mesh.positions[5].y = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(check_mesh(mesh), Contains("vertex 5 is not finite"));

  mesh = shapes::to_mesh(shapes::cube());
  mesh.triangles[2][0] = mesh.triangles[2][1];
  CHECK_THROWS_WITH(check_mesh(mesh), Contains("face 2 repeats a corner"));

  CHECK_THROWS_WITH(check_mesh(book()), Contains("directed edge (0, 1) is in face 0 and face 2"));
  CHECK_THROWS_WITH(check_mesh(bow_tie()), Contains("vertex 0 has more than one fan"));

  mesh = shapes::to_mesh(shapes::cube());
  mesh.sources.resize(3);
  CHECK_THROWS_AS(check_mesh(mesh), TopologyError);
}

TEST_CASE("check_mesh throws exactly where report_mesh sees a defect", "[mesh]") {
  // Random subsets of the faces of a torus, some turned over: every mixture of rules.
  const TriangleMesh torus = shapes::to_mesh(shapes::torus(1.0, 0.4, 16));
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    CAPTURE(seed);
    shapes::Random random(seed);
    TriangleMesh mesh = torus;
    std::erase_if(mesh.triangles, [&](const Triangle&) { return random.bits() % 12 == 0; });
    if (seed % 3 == 0) std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);
    bool passes = true;
    try {
      check_mesh(mesh);
    } catch (const TopologyError&) {
      passes = false;
    }
    REQUIRE(passes == report_mesh(mesh).is_manifold());
  }
}

TEST_CASE("report_mesh, check_mesh and self_intersections stop when the caller asks for the end",
          "[mesh]") {
  const TriangleMesh mesh = shapes::to_mesh(shapes::sphere(1.0, 8));
  std::stop_source source;
  source.request_stop();
  const Progress progress{.stop = source.get_token()};
  CHECK_THROWS_AS(report_mesh(mesh, progress), Cancelled);
  CHECK_THROWS_AS(check_mesh(mesh, progress), Cancelled);
  CHECK_THROWS_AS(self_intersections(mesh, progress), Cancelled);
  const std::vector<std::uint32_t> changed{0};
  CHECK_THROWS_AS(self_intersections(mesh, changed, {}, progress), Cancelled);
}

}  // namespace
}  // namespace rangezip
