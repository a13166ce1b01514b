#include "core/mask/morphology.h"

#include <catch2/catch.hpp>

#include "core/base/error.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

Mask random_mask(Extent extent, shapes::Random& random, unsigned percent) {
  Mask mask(extent, 0);
  for (std::uint8_t& pixel : mask.pixels())
    pixel = random.bits() % 100 < percent ? 1 : 0;
  return mask;
}

/// Pixels of `limit` that are not in `mask`.
Mask rest_of(const Mask& limit, const Mask& mask) {
  Mask rest = limit;
  for (std::size_t i = 0; i < rest.pixels().size(); ++i) {
    if (mask.pixels()[i] != 0) rest.pixels()[i] = 0;
  }
  return rest;
}

bool is_subset(const Mask& a, const Mask& b) {
  for (std::size_t i = 0; i < a.pixels().size(); ++i) {
    if (a.pixels()[i] > b.pixels()[i]) return false;
  }
  return true;
}

Mask rectangle(Extent extent, Pixel lower, Pixel upper) {
  Mask mask(extent, 0);
  for (int y = lower.y; y <= upper.y; ++y) {
    for (int x = lower.x; x <= upper.x; ++x)
      mask[{x, y}] = 1;
  }
  return mask;
}

TEST_CASE("erode and dilate move the border of a rectangle by one pixel", "[mask]") {
  const Extent extent{12, 10};
  const Mask all = full_mask(extent);
  CHECK(erode(rectangle(extent, {3, 3}, {8, 6}), all) == rectangle(extent, {4, 4}, {7, 5}));
  CHECK(dilate(rectangle(extent, {3, 3}, {8, 6}), all) == rectangle(extent, {2, 2}, {9, 7}));
}

TEST_CASE("erode does not wear away the limit's own border", "[mask]") {
  const Extent extent{9, 9};
  const Mask object = rectangle(extent, {2, 2}, {6, 6});
  CHECK(erode(object, object) == object);
  CHECK(erode(full_mask(extent), full_mask(extent)) == full_mask(extent));
}

TEST_CASE("dilate is erode of the complement within the limit", "[mask]") {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    CAPTURE(seed);
    shapes::Random random(seed);
    const Extent extent{1 + static_cast<int>(random.bits() % 20),
                        1 + static_cast<int>(random.bits() % 20)};
    const Mask limit = random_mask(extent, random, 85);
    Mask mask = random_mask(extent, random, 50);
    for (std::size_t i = 0; i < mask.pixels().size(); ++i) {
      if (limit.pixels()[i] == 0) mask.pixels()[i] = 0;
    }
    REQUIRE(dilate(mask, limit) == rest_of(limit, erode(rest_of(limit, mask), limit)));
    REQUIRE(is_subset(erode(mask, limit), mask));
    REQUIRE(is_subset(mask, dilate(mask, limit)));
    // Opening and closing are idempotent.
    const Mask opened = dilate(erode(mask, limit), limit);
    REQUIRE(dilate(erode(opened, limit), limit) == opened);
    REQUIRE(is_subset(opened, mask));
    REQUIRE(is_subset(clean_mask(mask, limit), limit));
  }
}

TEST_CASE("clean_mask removes specks, closes holes and keeps an overlap", "[mask]") {
  const Extent extent{20, 20};
  Mask mask = rectangle(extent, {5, 5}, {14, 14});
  mask[{1, 1}] = 1;
  const Mask cleaned = clean_mask(mask, full_mask(extent), {.erosions = 1, .dilations = 2});
  CHECK(cleaned == rectangle(extent, {4, 4}, {15, 15}));

  Mask with_hole = rectangle(extent, {5, 5}, {14, 14});
  with_hole[{10, 10}] = 0;
  CHECK(clean_mask(with_hole, full_mask(extent), {.erosions = 1, .dilations = 2}) ==
        rectangle(extent, {4, 4}, {15, 15}));
}

TEST_CASE("clean_mask never leaves the region, even with nothing to do", "[mask]") {
  const Extent extent{8, 8};
  const Mask region = rectangle(extent, {0, 0}, {3, 7});
  CHECK(clean_mask(full_mask(extent), region, {.erosions = 0, .dilations = 0}) == region);
}

TEST_CASE("morphology refuses other extents and negative counts", "[mask]") {
  const Mask small(Extent{3, 3}, 1);
  const Mask large(Extent{4, 3}, 1);
  CHECK_THROWS_AS(erode(small, large), InvalidArgument);
  CHECK_THROWS_AS(dilate(small, large), InvalidArgument);
  CHECK_THROWS_AS(clean_mask(small, large), InvalidArgument);
  CHECK_THROWS_AS(clean_mask(small, small, {.erosions = -1}), InvalidArgument);
  CHECK_THROWS_AS(clean_mask(small, small, {.erosions = 1, .dilations = -2}), InvalidArgument);
}

}  // namespace
}  // namespace rangezip
