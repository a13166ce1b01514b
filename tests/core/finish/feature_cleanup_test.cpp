#include "core/finish/feature_cleanup.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

TEST_CASE("a fin, three faces that fold over those around them, is taken off") {
  const TriangleMesh whole = testing::cube(4);
  CornerTable table(whole.triangles, whole.positions.size());
  std::vector<Vec3> positions = whole.positions;
  // Next to an inner edge of the top: the first face with all corners well inside of it.
  std::uint32_t face = 0;
  const auto is_inside = [&](std::uint32_t v) {
    const Vec3& p = positions[v];
    return p.z > 0.99 && std::max(std::abs(p.x), std::abs(p.y)) < 0.9;
  };
  while (!is_inside(table.vertex(3 * face)) || !is_inside(table.vertex(3 * face + 1)) ||
         !is_inside(table.vertex(3 * face + 2)))
    ++face;
  const Vec3 &a = positions[table.vertex(3 * face)], &b = positions[table.vertex(3 * face + 1)],
             &c = positions[table.vertex(3 * face + 2)];
  const Vec3 middle = 0.5 * (a + b);
  const Vec3 tip = middle + 0.1 * (middle - c) + Vec3(0.0, 0.0, 0.005);
  table.split(face);
  positions.push_back(tip);

  REQUIRE(remove_slivers(table, positions).collapsed_edges == 1);
  REQUIRE(table.triangles().size() == whole.triangles.size());
  REQUIRE(table.corner_of(static_cast<std::uint32_t>(positions.size() - 1)) == CornerTable::kNone);
  TriangleMesh mended{positions, table.triangles()};
  remove_unused_vertices(mended);
  REQUIRE(testing::volume_of(mended) == Approx(8.0));
}

}  // namespace
}  // namespace rangezip
