#include "core/finish/loop_neighbors.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

/// Triangles of their own, 1 to 2 across. Their corners lie on a lattice: so there are equal
/// distances, and some of exactly the reach.
/// @param size of the box that they begin in
TriangleMesh scattered_triangles(std::size_t count, const Vec3& size, std::mt19937_64& engine) {
  constexpr double kStep = 0.5;
  const auto between = [&](double lower, double upper) {
    return std::floor(testing::uniform(engine, lower, upper) / kStep) * kStep;
  };
  TriangleMesh mesh;
  for (std::size_t i = 0; i < count; ++i) {
    Vec3 a{0.0};
    for (int axis = 0; axis < 3; ++axis)
      a[axis] = between(-0.5 * size[axis], 0.5 * size[axis]);
    const double side = between(1.0, 2.5);
    testing::append(mesh, {{a, a + Vec3(0.0, side, 0.0), a + Vec3(0.0, 0.0, side)}, {{0, 1, 2}}});
  }
  return mesh;
}

bool are_equal(const LoopNeighbors& p, const LoopNeighbors& q) {
  return !(p < q) && !(q < p);
}

/// By comparing every vertex with every other one.
template <class AreWanted>
std::vector<LoopNeighbors> neighbors_of_all(const std::vector<std::vector<Vec3>>& loops,
                                            double reach, const AreWanted& are_wanted) {
  std::vector<LoopNeighbors> all;
  for (std::uint32_t a = 0; a < loops.size(); ++a) {
    for (std::uint32_t b = a + 1; b < loops.size(); ++b) {
      if (!are_wanted(a, b)) continue;
      for (std::uint32_t i = 0; i < loops[a].size(); ++i) {
        for (std::uint32_t j = 0; j < loops[b].size(); ++j)
          all.push_back({a, b, glm::length(loops[a][i] - loops[b][j]), i, j});
      }
    }
  }
  std::erase_if(all, [&](const LoopNeighbors& n) { return n.distance > reach; });
  std::sort(all.begin(), all.end());
  // The first entry for a vertex and another loop is the nearest one.
  using VertexAndLoop = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>;
  std::map<VertexAndLoop, LoopNeighbors> nearest;
  for (const LoopNeighbors& n : all) {
    nearest.emplace(VertexAndLoop{n.loop_a, n.place_a, n.loop_b}, n);
    nearest.emplace(VertexAndLoop{n.loop_b, n.place_b, n.loop_a}, n);
  }
  std::vector<LoopNeighbors> found;
  for (const auto& [vertex, neighbor] : nearest)
    found.push_back(neighbor);
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

TEST_CASE("neighbours of loops are those that comparing all vertices finds, in order", "[finish]") {
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  const Vec3 size = GENERATE(Vec3(12.0), Vec3(0.0, 30.0, 30.0), Vec3(60.0, 0.0, 0.0), Vec3(2.0));
  const double reach = GENERATE(0.5, 3.0);
  CAPTURE(seed, size.x, size.y, size.z, reach);
  std::mt19937_64 engine(seed);
  const TriangleMesh mesh = scattered_triangles(60, size, engine);
  const CornerTable table(mesh.triangles, mesh.positions.size());
  const std::vector<BoundaryLoop> loops = boundary_loops(table);
  std::vector<std::vector<Vec3>> places;
  for (const BoundaryLoop& loop : loops) {
    places.emplace_back();
    for (const std::uint32_t v : vertices_of(loop, table))
      places.back().push_back(mesh.positions[v]);
  }
  const auto are_wanted = [](std::uint32_t a, std::uint32_t b) { return (a + b) % 3 != 0; };
  const std::vector<LoopNeighbors> found =
      loop_neighbors(loops, table, mesh.positions, reach, are_wanted);
  const std::vector<LoopNeighbors> expected = neighbors_of_all(places, reach, are_wanted);
  CHECK_FALSE(expected.empty());
  CHECK(std::equal(found.begin(), found.end(), expected.begin(), expected.end(), are_equal));
}

}  // namespace rangezip
