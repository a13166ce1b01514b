#include "core/finish/triangulation_memo.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

using namespace rangezip;

namespace {

/// A ragged ring, so that no two triangulations are equally good.
LoopShape ragged_ring(std::uint32_t edges) {
  LoopShape shape;
  for (std::uint32_t i = 0; i < edges; ++i) {
    const double angle = 6.283185307179586 * i / edges;
    const double radius = 3.0 + 0.5 * std::sin(5.0 * angle) + 0.1 * std::sin(17.0 * i);
    shape.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle),
                              0.2 * std::cos(11.0 * i));
    shape.edge_normals.emplace_back(0.0, 0.0, 1.0);
  }
  return shape;
}

}  // namespace

TEST_CASE("what is remembered is what would be made, whatever of a loop has changed", "[finish]") {
  TriangulationMemo memo;
  LoopShape shape = ragged_ring(24);
  std::vector<LoopShape> shapes{shape};
  shape.points[5].z += 0.5;
  shapes.push_back(shape);
  shape.edge_normals[9] = Vec3(1.0, 0.0, 0.0);
  shapes.push_back(shape);
  shape.forbidden = {{0, 12}, {12, 0}};
  shapes.push_back(shape);
  shape.longest_edge = 5.0;
  shapes.push_back(shape);
  shape.is_in_air = [](const Vec3& place) { return place.x > 0.0; };
  shapes.push_back(shape);
  shape.long_side = 2.0;
  shapes.push_back(shape);
  for (int round = 0; round < 2; ++round) {
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      CAPTURE(round, i);
      CHECK(triangulate_loop(shapes[i], &memo) == triangulate_loop(shapes[i], nullptr));
    }
  }
}

TEST_CASE("a loop that is known is not triangulated again", "[finish]") {
  TriangulationMemo memo;
  LoopShape shape = ragged_ring(24);
  std::size_t asked = 0;
  shape.is_in_air = [&asked](const Vec3&) { return ++asked > 0; };
  const std::vector<Triangle> first = memo.triangulate(shape);
  REQUIRE(asked > 0);
  asked = 0;
  CHECK(memo.triangulate(shape) == first);
  CHECK(asked == 0);
}

TEST_CASE("no edge is made that is too long or that there is already", "[finish]") {
  LoopShape shape = ragged_ring(24);
  const auto has_edge = [](const std::vector<Triangle>& triangles, std::uint32_t i,
                           std::uint32_t k) {
    for (const Triangle& t : triangles) {
      for (std::size_t c = 0; c < 3; ++c) {
        if (t[c] == i && t[(c + 1) % 3] == k) return true;
      }
    }
    return false;
  };
  const std::vector<Triangle> any = triangulate_loop(shape);
  REQUIRE(any.size() == 22);
  for (const Triangle& t : any) {
    if (t[1] != t[0] + 2) continue;
    shape.forbidden = {{t[0], t[1]}, {t[1], t[0]}};
    CHECK_FALSE(has_edge(triangulate_loop(shape), t[0], t[1]));
    CHECK_FALSE(has_edge(triangulate_loop(shape), t[1], t[0]));
  }
  shape.forbidden.clear();
  shape.longest_edge = 1.0;  // no triangulation of a ring has short edges only
  CHECK(triangulate_loop(shape).empty());
}
