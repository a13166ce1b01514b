#include "core/base/grid.h"

#include <cstdint>
#include <numeric>

#include <catch2/catch.hpp>

namespace rangezip {
namespace {

TEST_CASE("an extent holds its pixels and numbers them row by row from the bottom", "[base]") {
  const Extent extent{3, 2};
  CHECK(extent.count() == 6);
  std::size_t expected = 0;
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 3; ++x) {
      CHECK(extent.contains({x, y}));
      CHECK(extent.index({x, y}) == expected++);
    }
  }
  for (const Pixel outside : {Pixel{-1, 0}, Pixel{3, 0}, Pixel{0, 2}, Pixel{0, -1}}) {
    CHECK_FALSE(extent.contains(outside));
  }
}

TEST_CASE("a grid's rows, pixels and spans are the same memory", "[base]") {
  Grid<std::int32_t> grid({4, 3}, 7);
  CHECK(std::accumulate(grid.pixels().begin(), grid.pixels().end(), 0) == 84);
  grid[{2, 1}] = -1;
  CHECK(grid.row(1)[2] == -1);
  CHECK(grid.pixels()[6] == -1);
  CHECK(grid.row(2).size() == 4);
  Grid<std::int32_t> copy = grid;
  CHECK(copy == grid);
  copy[{0, 0}] = 0;
  CHECK_FALSE(copy == grid);
  copy.reset({2, 2}, 5);
  CHECK(copy == Grid<std::int32_t>({2, 2}, 5));
  CHECK(Grid<std::int32_t>().extent() == Extent{0, 0});
}

}  // namespace
}  // namespace rangezip
