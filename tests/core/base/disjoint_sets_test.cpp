#include "core/base/disjoint_sets.h"

#include <algorithm>
#include <numeric>
#include <random>

#include <catch2/catch.hpp>

namespace rangezip {
namespace {

TEST_CASE("numbers are alone until they are joined, and joins are transitive", "[base]") {
  DisjointSets sets(5);
  CHECK(sets.find(3) == 3);
  sets.join(4, 2);
  sets.join(2, 3);
  for (const std::uint32_t i : {2U, 3U, 4U})
    CHECK(sets.find(i) == 2);
  CHECK(sets.find(0) == 0);
  sets.join(3, 4);  // no news
  CHECK(sets.find(1) == 1);
  sets.reset(3);
  CHECK(sets.find(2) == 2);
}

TEST_CASE("the lowest number stands for its set, whatever the order of the joins", "[base]") {
  constexpr std::uint32_t kCount = 60;
  constexpr std::uint32_t kStride = 7;  // i and i + 7 belong together
  std::vector<std::uint32_t> order(kCount - kStride);
  std::iota(order.begin(), order.end(), 0U);
  std::mt19937_64 engine(1);
  for (std::uint32_t round = 0; round < 20; ++round) {
    std::shuffle(order.begin(), order.end(), engine);
    DisjointSets sets(kCount);
    for (const std::uint32_t i : order)
      sets.join(i + (round % 2) * kStride, i + ((round + 1) % 2) * kStride);
    for (std::uint32_t i = 0; i < kCount; ++i)
      REQUIRE(sets.find(i) == i % kStride);
  }
}

}  // namespace
}  // namespace rangezip
