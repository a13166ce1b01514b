#include "core/mask/mask.h"

#include <limits>

#include <catch2/catch.hpp>

#include "core/base/error.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

std::size_t count_of(const Mask& mask) {
  return static_cast<std::size_t>(std::count(mask.pixels().begin(), mask.pixels().end(), 1));
}

/// Even-odd rule by brute force: edges of the polygon strictly to the right of the point. All
/// corners lie on multiples of 1/4 here, so every product is exact.
bool is_inside(const std::vector<Vec2>& polygon, const Vec2& p) {
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    Vec2 a = polygon[i];
    Vec2 b = polygon[(i + 1) % polygon.size()];
    if ((a.y <= p.y) == (b.y <= p.y)) continue;
    if (a.y > b.y) std::swap(a, b);
    if ((b.x - a.x) * (p.y - a.y) > (b.y - a.y) * (p.x - a.x)) inside = !inside;
  }
  return inside;
}

TEST_CASE("mask_from_lasso of a rectangle holds the pixels whose centres it holds", "[mask]") {
  const std::vector<Vec2> lasso{{2, 1}, {7, 1}, {7, 4}, {2, 4}};
  const Mask mask = mask_from_lasso({10, 6}, lasso);
  CHECK(count_of(mask) == 15);
  CHECK(mask[{2, 1}] == 1);
  CHECK(mask[{6, 3}] == 1);
  CHECK(mask[{7, 3}] == 0);
  CHECK(mask[{6, 4}] == 0);
}

TEST_CASE("two lassos that share an edge through pixel centres split the pixels", "[mask]") {
  const Extent extent{12, 12};
  const std::vector<Vec2> left{{0, 0}, {5.5, 0}, {5.5, 12}, {0, 12}};
  const std::vector<Vec2> right{{5.5, 0}, {12, 0}, {12, 12}, {5.5, 12}};
  const Mask a = mask_from_lasso(extent, left);
  const Mask b = mask_from_lasso(extent, right);
  for (std::size_t i = 0; i < extent.count(); ++i)
    REQUIRE(a.pixels()[i] + b.pixels()[i] == 1);
  CHECK(b[{5, 3}] == 1);  // a centre on the edge belongs to the side on its right
}

TEST_CASE("mask_from_lasso agrees with the even-odd rule, ties and crossings included", "[mask]") {
  const Extent extent{20, 16};
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    CAPTURE(seed);
    shapes::Random random(seed);
    std::vector<Vec2> lasso(3 + random.bits() % 9);
    for (Vec2& corner : lasso) {
      // Multiples of 1/2 from -5 to 25: many corners and edges on pixel centres, some outside.
      corner = {0.5 * static_cast<double>(random.bits() % 61) - 5.0,
                0.5 * static_cast<double>(random.bits() % 53) - 5.0};
    }
    const Mask mask = mask_from_lasso(extent, lasso);
    for (int y = 0; y < extent.height; ++y) {
      for (int x = 0; x < extent.width; ++x) {
        REQUIRE(mask[{x, y}] == (is_inside(lasso, {x + 0.5, y + 0.5}) ? 1 : 0));
      }
    }
  }
}

TEST_CASE("mask_from_lasso takes corners far outside of the image", "[mask]") {
  const std::vector<Vec2> around{{-1e9, -1e9}, {1e9, -1e9}, {1e9, 1e9}, {-1e9, 1e9}};
  CHECK(mask_from_lasso({5, 4}, around) == full_mask({5, 4}));
  const std::vector<Vec2> astronomic{{-1e308, -1e308}, {1e308, -1e308}, {0.0, 1e308}};
  CHECK_NOTHROW(mask_from_lasso({5, 4}, astronomic));
}

TEST_CASE("mask_from_lasso refuses what is no polygon", "[mask]") {
  const std::vector<Vec2> two{{0, 0}, {1, 1}};
  CHECK_THROWS_AS(mask_from_lasso({4, 4}, two), InvalidArgument);
  const std::vector<Vec2> infinite{{0, 0}, {1, std::numeric_limits<double>::infinity()}, {1, 0}};
  CHECK_THROWS_AS(mask_from_lasso({4, 4}, infinite), InvalidArgument);
}

TEST_CASE("sample_mask marks the samples", "[mask]") {
  RangeImage image(View(Camera{}, {3, 2}));
  image[{1, 1}] = 0.0;
  const Mask mask = sample_mask(image);
  CHECK(count_of(mask) == 1);
  CHECK(mask[{1, 1}] == 1);
  CHECK(count_of(full_mask({3, 2})) == 6);
}

}  // namespace
}  // namespace rangezip
