#include "core/finish/settled_loops.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

std::size_t count_settled(const TriangleMesh& mesh, const SettledLoops& settled) {
  const CornerTable table(mesh.triangles, mesh.positions.size());
  const std::vector<BoundaryLoop> loops = boundary_loops(table);
  return static_cast<std::size_t>(
      std::count_if(loops.begin(), loops.end(),
                    [&](const BoundaryLoop& loop) { return settled.contain(loop, table); }));
}

/// Drops the faces with a corner where `inside` holds; vertices keep their numbers.
template <class Inside>
void cut_faces(TriangleMesh& mesh, Inside inside) {
  std::erase_if(mesh.triangles, [&](const Triangle& t) {
    return std::any_of(t.begin(), t.end(),
                       [&](std::uint32_t v) { return inside(mesh.positions[v]); });
  });
}

}  // namespace

TEST_CASE("loops that were there are settled, also where a cut bites into one; new ones are not",
          "[finish]") {
  TriangleMesh mesh = testing::sphere(24);
  CHECK(count_settled(mesh, SettledLoops(mesh)) == 0);
  cut_faces(mesh, [](const Vec3& p) { return std::abs(p.z) > 0.8; });
  const SettledLoops settled(mesh);
  CHECK(count_settled(mesh, settled) == 2);
  CHECK(count_settled(mesh, SettledLoops()) == 0);
  cut_faces(mesh, [](const Vec3& p) { return p.x > 0.95; });
  CHECK(count_settled(mesh, settled) == 2);  // of three
  cut_faces(mesh, [](const Vec3& p) { return p.y > 0.6 && p.z > 0.5; });
  CHECK(count_settled(mesh, settled) == 2);
}

}  // namespace rangezip
