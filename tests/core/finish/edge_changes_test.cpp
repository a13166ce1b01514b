#include "core/finish/edge_changes.h"

#include <catch2/catch.hpp>
#include <map>

#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

TEST_CASE("a diamond tells what its faces are like once the edge has turned") {
  const TriangleMesh mesh = testing::sphere(4);
  const CornerTable table(mesh.triangles, mesh.positions.size());
  int turned = 0;
  for (std::uint32_t c = 0; c < table.corner_count(); ++c) {
    if (!table.names_inner_edge(c) || !table.is_flip_ok(c)) continue;
    const Diamond before(table, c);
    CornerTable after = table;
    after.flip(c);
    const auto joins = [&](std::uint32_t corner) {
      const std::uint32_t v = after.vertex(corner), w = after.head(corner);
      return after.names_inner_edge(corner) && std::minmax(v, w) == std::minmax(before.x, before.y);
    };
    for (std::uint32_t corner = 0; corner < after.corner_count(); ++corner) {
      if (!joins(corner)) continue;
      const double angle = angle_before_flip(mesh.positions, Diamond(after, corner));
      CHECK(angle == Approx(angle_after_flip(mesh.positions, before)).epsilon(1e-12));
      ++turned;
    }
    // Two ways to span the same four edges: their area vectors add up to the same.
    const DiamondAreas areas(mesh.positions, before);
    CHECK(glm::length(areas.old_x + areas.old_y - areas.new_a - areas.new_b) < 1e-12);
  }
  REQUIRE(turned > 100);
}

TEST_CASE("the faces after a collapse are those around the head that were not there before") {
  const TriangleMesh mesh = testing::sphere(3);
  const CornerTable table(mesh.triangles, mesh.positions.size());
  int collapsed = 0;
  for (std::uint32_t c = 0; c < table.corner_count(); ++c) {
    if (!table.is_collapse_ok(c)) continue;
    const std::uint32_t head = table.head(c);
    std::map<std::uint32_t, std::uint32_t> edges_before, edges_after, told;
    const auto collect = [&](const CornerTable& from, auto& edges) {
      from.for_each_corner(head, [&](std::uint32_t k) { edges[from.head(k)] = from.apex(k); });
    };
    collect(table, edges_before);
    for_each_face_after_collapse(table, c, [&](std::uint32_t p, std::uint32_t q) { told[p] = q; });
    CornerTable after = table;
    after.collapse(c);
    collect(after, edges_after);
    std::erase_if(edges_after, [&](const auto& edge) {
      return edges_before.count(edge.first) != 0 && edges_before[edge.first] == edge.second;
    });
    CHECK(told == edges_after);
    ++collapsed;
  }
  REQUIRE(collapsed > 100);
}

}  // namespace
}  // namespace rangezip
