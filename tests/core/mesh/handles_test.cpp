#include "core/mesh/handles.h"

#include <algorithm>
#include <numeric>

#include <catch2/catch.hpp>

#include "core/finish/clean_topology.h"
#include "core/mesh/mesh_report.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

/// By Euler's formula from what report_mesh() counts edge by edge.
std::size_t handles_by_edges(const TriangleMesh& mesh) {
  const MeshReport report = report_mesh(mesh);
  REQUIRE(report.is_manifold());
  const auto loops = static_cast<std::ptrdiff_t>(report.boundary_loops);
  const auto components = static_cast<std::ptrdiff_t>(report.components);
  return static_cast<std::size_t>((2 * components - loops - report.euler) / 2);
}

/// The same surface with its vertices in another order.
TriangleMesh shuffled(TriangleMesh mesh, shapes::Random& random) {
  std::vector<std::uint32_t> place(mesh.positions.size());
  std::iota(place.begin(), place.end(), 0U);
  for (std::size_t i = place.size(); i > 1; --i)
    std::swap(place[i - 1], place[random.bits() % i]);
  const std::vector<Vec3> positions = mesh.positions;
  for (std::size_t v = 0; v < place.size(); ++v)
    mesh.positions[place[v]] = positions[v];
  for (Triangle& t : mesh.triangles)
    t = {place[t[0]], place[t[1]], place[t[2]]};
  return mesh;
}

TEST_CASE("a surface has as many handles as holes lead through it", "[mesh]") {
  CHECK(count_handles({}) == 0);
  CHECK(count_handles(shapes::to_mesh(shapes::sphere(1.0, 12))) == 0);
  CHECK(count_handles(shapes::to_mesh(shapes::bowl(1.0, 12))) == 0);
  CHECK(count_handles(shapes::to_mesh(shapes::shell(0.1, 1.0, 12))) == 0);
  CHECK(count_handles(shapes::to_mesh(shapes::torus(1.0, 0.4, 24))) == 1);
  CHECK(count_handles(shapes::to_mesh(shapes::trefoil(0.35, 60, 8))) == 1);
  const TriangleSoup torus = shapes::torus(1.0, 0.4, 24);
  const TriangleSoup far = shapes::moved(torus, shapes::translation({5, 0, 0}));
  CHECK(count_handles(shapes::to_mesh(shapes::merged(torus, far))) == 2);
}

TEST_CASE("a torus keeps its handle when it gets holes, and loses it when it is cut through",
          "[mesh]") {
  const TriangleMesh torus = shapes::to_mesh(shapes::torus(1.0, 0.4, 24));
  TriangleMesh punctured = torus;
  punctured.triangles.erase(punctured.triangles.begin() + 100);
  punctured.triangles.erase(punctured.triangles.begin());
  CHECK(count_handles(punctured) == 1);
  TriangleMesh cut = torus;
  std::erase_if(cut.triangles, [&](const Triangle& t) {
    return std::all_of(t.begin(), t.end(), [&](std::uint32_t v) {
      return torus.positions[v].x > 0.0 && std::abs(torus.positions[v].y) < 0.4;
    });
  });
  REQUIRE(cut.triangles.size() < torus.triangles.size());
  CHECK(count_handles(cut) == 0);
}

TEST_CASE(
    "handles are those of Euler's formula, whatever was cut out and however vertices are "
    "numbered",
    "[mesh]") {
  const std::uint64_t seed = GENERATE(range(std::uint64_t{1}, std::uint64_t{21}));
  CAPTURE(seed);
  shapes::Random random(seed);
  const TriangleSoup torus = shapes::torus(1.0, 0.4, 24);
  TriangleMesh mesh =
      shapes::to_mesh(shapes::merged(torus, shapes::moved(torus, shapes::translation({4, 0, 0}))));
  std::erase_if(mesh.triangles, [&](const Triangle&) { return random.unit() < 0.05; });
  clean_topology(mesh);
  mesh = shuffled(std::move(mesh), random);
  CHECK(count_handles(mesh) == handles_by_edges(mesh));
}

}  // namespace
}  // namespace rangezip
