#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "core/mesh/self_intersection.h"
#include "core/mesh/triangle_overlap.h"
#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
using testing::uniform;

Kernel::Point_3 point(const Vec3& p) {
  return {p.x, p.y, p.z};
}

Pairs judged(const TriangleMesh& mesh) {
  Surface surface;
  for (const Vec3& p : mesh.positions)
    surface.add_vertex(point(p));
  for (const Triangle& t : mesh.triangles) {
    using Vertex = Surface::Vertex_index;
    REQUIRE(surface.add_face(Vertex(t[0]), Vertex(t[1]), Vertex(t[2])) != Surface::null_face());
  }
  std::vector<std::pair<Surface::Face_index, Surface::Face_index>> found;
  CGAL::Polygon_mesh_processing::self_intersections(surface, std::back_inserter(found));
  Pairs pairs;
  for (const auto& [f, g] : found) {
    const auto i = static_cast<std::uint32_t>(f), j = static_cast<std::uint32_t>(g);
    pairs.emplace_back(std::min(i, j), std::max(i, j));
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// Few different coordinates: touching, coplanar, collinear and equal things are common.
Vec3 coarse_point(std::mt19937_64& engine, int steps) {
  const auto c = [&] { return std::floor(uniform(engine, 0.0, steps)); };
  return {c(), c(), c()};
}

TEST_CASE("random separate triangles on a coarse lattice are judged as CGAL judges them") {
  const int steps = GENERATE(2, 3, 4, 6);
  std::mt19937_64 engine(static_cast<std::uint64_t>(steps));
  int meeting = 0;
  for (int i = 0; i < 20000; ++i) {
    TriangleMesh mesh;
    for (int k = 0; k < 6; ++k)
      mesh.positions.push_back(coarse_point(engine, steps));
    mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
    if (is_degenerate(mesh, mesh.triangles[0]) || is_degenerate(mesh, mesh.triangles[1])) continue;
    const auto& p = mesh.positions;
    const bool expected =
        CGAL::do_intersect(Kernel::Triangle_3(point(p[0]), point(p[1]), point(p[2])),
                           Kernel::Triangle_3(point(p[3]), point(p[4]), point(p[5])));
    CAPTURE(steps, i);
    REQUIRE(overlap(mesh, mesh.triangles[0], mesh.triangles[1]) == expected);
    meeting += expected ? 1 : 0;
  }
  REQUIRE(meeting > 1000);
}

TEST_CASE("jittered and folded spheres are judged as CGAL judges them") {
  const int seed = GENERATE(range(0, 12));
  std::mt19937_64 engine(static_cast<std::uint64_t>(seed));
  TriangleMesh mesh = testing::sphere(12);
  // From hardly crumpled to a ball of paper; odd seeds fall on a lattice, with degenerate
  // triangles.
  const double amount = 0.03 * (1 + seed);
  for (Vec3& p : mesh.positions) {
    p += amount * Vec3{uniform(engine, -1, 1), uniform(engine, -1, 1), uniform(engine, -1, 1)};
    constexpr double kLattice = 16.0;
    if (seed % 2 == 1) p = glm::round(p * kLattice) / kLattice;
  }
  CAPTURE(seed);
  REQUIRE(self_intersections(mesh) == judged(mesh));
}

TEST_CASE("flat sheets folded over their edges are judged as CGAL judges them") {
  const int seed = GENERATE(range(0, 8));
  std::mt19937_64 engine(static_cast<std::uint64_t>(100 + seed));
  TriangleMesh mesh = testing::cube(6);
  for (Vec3& p : mesh.positions)
    p.z = 0.0;  // the sides get no area, top and bottom coincide
  for (Vec3& p : mesh.positions) {
    if (uniform(engine, 0, 1) < 0.3) p.x += std::floor(uniform(engine, -2, 3)) / 3.0;
  }
  CAPTURE(seed);
  REQUIRE(self_intersections(mesh) == judged(mesh));
}

}  // namespace
}  // namespace rangezip
