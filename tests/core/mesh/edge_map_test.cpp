#include "core/mesh/edge_map.h"

#include <map>
#include <utility>

#include <catch2/catch.hpp>

#include "tests/support/shapes.h"

namespace rangezip {
namespace {

TEST_CASE("EdgeMap agrees with an ordered map over random inserts and erasures", "[mesh]") {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    CAPTURE(seed);
    shapes::Random random(seed);
    EdgeMap edges(seed % 2 == 0 ? 0 : 4000);  // growing or not must not matter
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> expected;
    for (std::uint32_t step = 0; step < 20000; ++step) {
      const auto from = static_cast<std::uint32_t>(random.bits() % 60);
      const auto to = static_cast<std::uint32_t>(random.bits() % 60);
      if (random.bits() % 3 == 0) {
        edges.erase(from, to);
        expected.erase({from, to});
      } else {
        REQUIRE(edges.insert(from, to, step) == expected.emplace(std::pair{from, to}, step).second);
      }
      REQUIRE(edges.size() == expected.size());
    }
    for (std::uint32_t from = 0; from < 60; ++from) {
      for (std::uint32_t to = 0; to < 60; ++to) {
        const auto found = expected.find({from, to});
        REQUIRE(edges.find(from, to) == (found == expected.end() ? EdgeMap::kNone : found->second));
      }
    }
  }
}

TEST_CASE("EdgeMap tells an edge from its opposite and takes the largest indices", "[mesh]") {
  EdgeMap edges;
  CHECK(edges.insert(3, 4, 10));
  CHECK(edges.find(4, 3) == EdgeMap::kNone);
  CHECK(edges.insert(4, 3, 11));
  CHECK_FALSE(edges.insert(3, 4, 12));
  CHECK(edges.find(3, 4) == 10);
  CHECK(edges.insert(0xffff'fffeU, 0xffff'fffdU, 13));
  CHECK(edges.find(0xffff'fffeU, 0xffff'fffdU) == 13);
}

}  // namespace
}  // namespace rangezip
