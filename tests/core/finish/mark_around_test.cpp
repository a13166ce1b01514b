#include "core/finish/mark_around.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// Of faces that mostly lie near each other.
Pairs random_pairs(std::size_t count, std::size_t faces, std::mt19937_64& engine) {
  constexpr std::size_t kApart = 20;
  Pairs pairs(count);
  for (auto& [i, j] : pairs) {
    i = static_cast<std::uint32_t>(engine() % faces);
    j = static_cast<std::uint32_t>((i + engine() % kApart) % faces);
  }
  return pairs;
}

bool is_inside(const Vec3& place, const Box& box) {
  return place == glm::clamp(place, box.lower, box.upper);
}

}  // namespace

TEST_CASE("places in the boxes around pairs of faces are flagged, others stay as they are",
          "[finish]") {
  const auto seed = static_cast<std::uint64_t>(Catch::rngSeed());
  const std::size_t count = GENERATE(0U, 1U, 40U);
  CAPTURE(seed, count);
  std::mt19937_64 engine(seed);
  const TriangleMesh mesh = testing::sphere(8);
  const TriangleMesh fine = testing::sphere(16);  // with all of its vertices, on sides of boxes
  const Pairs pairs = random_pairs(count, mesh.triangles.size(), engine);
  std::vector<std::uint8_t> marked(fine.positions.size());
  for (std::uint8_t& mark : marked)
    mark = engine() % 10 == 0 ? 1 : 0;
  std::vector<std::uint8_t> expected = marked;
  for (const auto& [i, j] : pairs) {
    Box box = box_of(mesh, mesh.triangles[i]);
    box.add(box_of(mesh, mesh.triangles[j]));
    for (std::size_t v = 0; v < expected.size(); ++v) {
      if (is_inside(fine.positions[v], box)) expected[v] = 1;
    }
  }
  mark_around(mesh, pairs, fine.positions, marked);
  CHECK(marked == expected);
  CHECK(std::count(marked.begin(), marked.end(), 0) > 0);
}

}  // namespace rangezip
