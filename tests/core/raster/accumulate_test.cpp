#include <catch2/catch.hpp>

#include "core/base/error.h"
#include "tests/core/raster/drawing.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

using drawing::for_each_backend;
using lattice::px;

constexpr Extent kExtent{20, 16};

Grid<PixelMoments> accumulate(Rasterizer& rasterizer, const std::vector<DrawItem>& items,
                              const AccumulateWindow& window) {
  Grid<PixelMoments> sums;
  rasterizer.accumulate(lattice::view(window.reference.extent()), items, window, sums);
  return sums;
}

TEST_CASE("a point on a pixel's centre adds to that pixel only") {
  for_each_backend([](Rasterizer& rasterizer) {
    const std::vector<Vec3f> position{{px(7.5), px(3.5), 5016}};
    const std::vector<std::int8_t> votes{-9};
    DrawPoints item = lattice::points(kExtent, position, 0, 5);  // the size plays no part
    item.votes = votes;
    const auto sums = accumulate(rasterizer, {item}, lattice::whole_window(kExtent, 5000, 4));
    Grid<PixelMoments> expected(kExtent);
    expected[{7, 3}] = {.w = 65536, .w_z = 65536, .w_vote = -9 * 65536};
    CHECK(sums == expected);
  });
}

TEST_CASE("a point on a corner of four pixels adds a quarter to each") {
  for_each_backend([](Rasterizer& rasterizer) {
    const std::vector<Vec3f> position{{px(8), px(4), 1 << 20}};
    const auto sums = accumulate(rasterizer, {lattice::points(kExtent, position)},
                                 lattice::whole_window(kExtent, (1 << 20) + 48, 4));
    Grid<PixelMoments> expected(kExtent);
    for (const int right : {0, 1}) {
      for (const int above : {0, 1}) {
        const std::int64_t w = 128 * 128;
        const std::int64_t dx = right == 1 ? -128 : 128;
        const std::int64_t dy = above == 1 ? -128 : 128;
        expected[{7 + right, 3 + above}] = {.w = w,
                                            .w_dx = w * dx,
                                            .w_dy = w * dy,
                                            .w_dx_dx = w * dx * dx,
                                            .w_dx_dy = w * dx * dy,
                                            .w_dy_dy = w * dy * dy,
                                            .w_z = -3 * w,
                                            .w_z_dx = -3 * w * dx,
                                            .w_z_dy = -3 * w * dy};
      }
    }
    CHECK(sums == expected);
  });
}

TEST_CASE("the weights of a point add up to one, and their offsets to none") {
  for_each_backend([](Rasterizer& rasterizer) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      CAPTURE(seed);
      shapes::Random random(seed);
      std::vector<Vec3f> positions;
      for (int i = 0; i < 500; ++i) {
        positions.push_back({random.between(px(1), px(kExtent.width - 1)),
                             random.between(px(1), px(kExtent.height - 1)),
                             random.between(0, 1e7)});
      }
      const auto sums = accumulate(rasterizer, {lattice::points(kExtent, positions)},
                                   lattice::whole_window(kExtent, 0, 4));
      PixelMoments total;
      for (const PixelMoments& m : sums.pixels()) {
        total.w += m.w;
        total.w_dx += m.w_dx;
        total.w_dy += m.w_dy;
      }
      // Tents reproduce constants and linear functions.
      CHECK(total == PixelMoments{.w = 500 * 65536});
    }
  });
}

TEST_CASE("points on a plane give the plane back") {
  for_each_backend([](Rasterizer& rasterizer) {
    // z = 100000 + 3 x - 5 y in 1/256 px, exact in integers.
    shapes::Random random(3);
    std::vector<Vec3f> positions;
    for (int i = 0; i < 5000; ++i) {
      const auto x = static_cast<int>(random.between(0, px(kExtent.width)));
      const auto y = static_cast<int>(random.between(0, px(kExtent.height)));
      positions.emplace_back(x, y, 100'000 + 3 * x - 5 * y);
    }
    const auto sums = accumulate(rasterizer, {lattice::points(kExtent, positions)}, [] {
      auto window = lattice::whole_window(kExtent, 0, 0);
      for (auto& upper : window.band.upper.pixels())
        upper = 1 << 19;
      return window;
    }());
    for (int y = 0; y < kExtent.height; ++y) {
      for (int x = 0; x < kExtent.width; ++x) {
        const PixelMoments& m = sums[{x, y}];
        REQUIRE(m.w > 0);
        const std::int64_t at_centre = 100'000 + 3 * (256 * x + 128) - 5 * (256 * y + 128);
        CHECK(m.w_z == at_centre * m.w + 3 * m.w_dx - 5 * m.w_dy);
        CHECK(m.w_z_dx == at_centre * m.w_dx + 3 * m.w_dx_dx - 5 * m.w_dx_dy);
        CHECK(m.w_z_dy == at_centre * m.w_dy + 3 * m.w_dx_dy - 5 * m.w_dy_dy);
      }
    }
  });
}

TEST_CASE("only points inside of the pixel's window count, ends included, and triangles never") {
  for_each_backend([](Rasterizer& rasterizer) {
    const std::vector<Vec3f> positions{{px(3.5), px(3.5), 99},
                                       {px(3.5), px(3.5), 100},
                                       {px(3.5), px(3.5), 200},
                                       {px(3.5), px(3.5), 201}};
    const std::vector<Vec3f> corners{{0, 0, 150}, {px(9), 0, 150}, {0, px(9), 150}};
    const std::vector<Triangle> faces{{0, 1, 2}};
    AccumulateWindow window = lattice::whole_window(kExtent, 100, 0);
    for (auto& lower : window.band.lower.pixels())
      lower = 100;
    for (auto& upper : window.band.upper.pixels())
      upper = 200;
    const auto sums = accumulate(
        rasterizer,
        {lattice::points(kExtent, positions), lattice::triangles(kExtent, corners, faces, 4)},
        window);
    Grid<PixelMoments> expected(kExtent);
    expected[{3, 3}] = {.w = 2 * 65536, .w_z = 100 * 65536};
    CHECK(sums == expected);
  });
}

TEST_CASE("points in front of the near plane or behind the far plane add nothing") {
  for_each_backend([](Rasterizer& rasterizer) {
    const std::vector<Vec3f> positions{{px(3.5), px(3.5), -1},
                                       {px(3.5), px(3.5), static_cast<float>(kMaxDepth) + 1}};
    AccumulateWindow window = lattice::whole_window(kExtent, 0, 8);
    for (auto& lower : window.band.lower.pixels())
      lower = -100;
    for (auto& upper : window.band.upper.pixels())
      upper = 1 << 25;
    CHECK(accumulate(rasterizer, {lattice::points(kExtent, positions)}, window) ==
          Grid<PixelMoments>(kExtent));
  });
}

TEST_CASE("accumulate counts the points it drops") {
  for_each_backend([](Rasterizer& rasterizer) {
    const std::vector<Vec3f> positions{{px(3.5), px(3.5), 5}, {1e8F, 0, 0}, {0, -1e30F, 0}};
    Grid<PixelMoments> sums;
    const DrawReport report = rasterizer.accumulate(
        lattice::view(kExtent), std::vector<DrawItem>{lattice::points(kExtent, positions)},
        lattice::whole_window(kExtent, 0, 4), sums);
    CHECK(report.dropped_points == 2);
  });
}

TEST_CASE("a pixel takes 2^19 points and refuses one more") {
  for_each_backend([](Rasterizer& rasterizer) {
    constexpr std::size_t kMost = std::size_t{1} << 19;
    // A quarter of a pixel from the centre, at the greatest depth offset there may be.
    std::vector<Vec3f> positions(kMost, Vec3f{px(5.75), px(2.25), (1 << 20) - 1});
    AccumulateWindow window = lattice::whole_window(kExtent, 0, 0);
    for (auto& upper : window.band.upper.pixels())
      upper = (1 << 20) - 1;
    const auto sums = accumulate(rasterizer, {lattice::points(kExtent, positions)}, window);
    const std::int64_t w = 192 * 192;
    const auto n = static_cast<std::int64_t>(kMost);
    const PixelMoments& m = sums[{5, 2}];
    CHECK(m.w == n * w);
    CHECK(m.w_dx_dx == n * w * 64 * 64);
    CHECK(m.w_z_dx == n * w * 64 * ((1 << 20) - 1));
    CHECK(m.w_z_dy == -n * w * 64 * ((1 << 20) - 1));

    positions.push_back(positions.back());
    CHECK_THROWS_AS(accumulate(rasterizer, {lattice::points(kExtent, positions)}, window), Error);
    CHECK_THROWS_WITH(accumulate(rasterizer, {lattice::points(kExtent, positions)}, window),
                      Catch::Contains("2^19"));
    // As two items, the sum is the same.
    const std::vector<Vec3f> one(1, positions.back());
    positions.pop_back();
    const std::vector<DrawItem> apart{lattice::points(kExtent, positions),
                                      lattice::points(kExtent, one, kMost)};
    CHECK_THROWS_AS(accumulate(rasterizer, apart, window), Error);
  });
}

}  // namespace
}  // namespace rangezip
