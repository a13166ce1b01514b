#include "core/image/fill_holes.h"

#include <catch2/catch.hpp>

#include "core/base/error.h"
#include "tests/support/images.h"

namespace rangezip {
namespace {

TEST_CASE("fill_holes closes single pixels of a plane with the plane's depth", "[image]") {
  const auto plane = [](Pixel p) { return 10.0 + 0.5 * p.x - 0.25 * p.y; };
  const View view = images::parallel_view({16, 12});
  RangeImage image = images::image_of(view, plane);
  for (const Pixel hole : {Pixel{3, 3}, Pixel{8, 5}, Pixel{12, 9}})
    image[hole] = kNoSample;
  const FillHolesResult result = fill_holes(image);
  CHECK(images::count_of(result.filled) == 3);
  // Quarters: the mean of the eight neighbours is exact.
  CHECK(result.image == images::image_of(view, plane));
}

TEST_CASE("fill_holes never changes a sample", "[image]") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    const RangeImage image = images::rough_image({40, 30}, seed);
    const FillHolesResult result = fill_holes(image, {.min_neighbours = 4, .rounds = 3});
    for (std::size_t i = 0; i < image.depth().pixels().size(); ++i) {
      const double before = image.depth().pixels()[i];
      const double after = result.image.depth().pixels()[i];
      REQUIRE((before == kNoSample || after == before));
      const bool made = before == kNoSample && after != kNoSample;
      REQUIRE(result.filled.pixels()[i] == (made ? 1 : 0));
    }
    // Filled depths lie among their neighbours'.
    REQUIRE(images::count_of(result.filled) > 0);
  }
}

TEST_CASE("fill_holes of a mirrored image is the mirrored result", "[image]") {
  const RangeImage image = images::rough_image({41, 30}, 7);
  CHECK(fill_holes(images::mirrored(image)).image == images::mirrored(fill_holes(image).image));
}

TEST_CASE("fill_holes at a silhouette takes the front sheet", "[image]") {
  RangeImage image = images::image_of(images::parallel_view({9, 9}),
                                      [](Pixel p) { return p.x < 5 ? 10.0 : 20.0; });
  image[{4, 4}] = kNoSample;  // five neighbours at 10, three at 20
  CHECK(fill_holes(image).image[{4, 4}] == 10.0);
  // Three on the front sheet are too few to speak for it, and the others do not count.
  RangeImage behind = images::image_of(images::parallel_view({9, 9}),
                                       [](Pixel p) { return p.x < 4 ? 10.0 : 20.0; });
  behind[{4, 4}] = kNoSample;
  CHECK_FALSE(fill_holes(behind).image.has_sample({4, 4}));
}

TEST_CASE("fill_holes does not grow the object, and stops after its rounds", "[image]") {
  RangeImage half = images::image_of(images::parallel_view({10, 10}),
                                     [](Pixel p) { return p.x < 5 ? 10.0 : kNoSample; });
  CHECK(fill_holes(half, {.rounds = 10}).image == half);

  // A hole of 2 x 2 pixels: its corners have five neighbours each.
  RangeImage image = images::image_of(images::parallel_view({10, 10}), [](Pixel) { return 10.0; });
  for (const Pixel p : {Pixel{4, 4}, Pixel{5, 4}, Pixel{4, 5}, Pixel{5, 5}})
    image[p] = kNoSample;
  CHECK(fill_holes(image, {.rounds = 0}).image == image);
  CHECK(images::count_of(fill_holes(image, {.rounds = 1}).filled) == 4);
  CHECK(fill_holes(image, {.min_neighbours = 6, .rounds = 9}).image == image);
}

TEST_CASE("fill_holes joins rows of samples that are within reach, exactly on a plane", "[image]") {
  const auto plane = [](Pixel p) { return 10.0 + 0.5 * p.x - 0.25 * p.y; };
  const View view = images::parallel_view({16, 13});
  RangeImage rows = images::image_of(view, plane);
  for (int y = 0; y < 13; ++y) {
    for (int x = 0; x < 16; ++x) {
      if (y % 4 != 0) rows[{x, y}] = kNoSample;
    }
  }
  const FillHolesResult joined = fill_holes(rows, {.rounds = 0, .reach = 4});
  CHECK(joined.image == images::image_of(view, plane));
  CHECK(images::count_of(joined.filled) == 16 * 9);
  CHECK(fill_holes(rows, {.rounds = 0, .reach = 3}).image == rows);
}

TEST_CASE("fill_holes joins no sheets of different depth and does not grow silhouettes",
          "[image]") {
  const RangeImage apart = images::image_of(images::parallel_view({12, 8}), [](Pixel p) {
    return p.x < 4 ? 10.0 : p.x < 7 ? kNoSample : 30.0;  // a step of 5 pixel sides a pixel
  });
  CHECK(fill_holes(apart, {.rounds = 0, .reach = 6}).image == apart);
  const RangeImage half = images::image_of(images::parallel_view({12, 8}),
                                           [](Pixel p) { return p.x < 4 ? 10.0 : kNoSample; });
  CHECK(fill_holes(half, {.rounds = 0, .reach = 6}).image == half);
}

TEST_CASE("fill_holes refuses impossible options", "[image]") {
  const RangeImage image(images::parallel_view({3, 3}));
  CHECK_THROWS_AS(fill_holes(image, {.min_neighbours = 0}), InvalidArgument);
  CHECK_THROWS_AS(fill_holes(image, {.min_neighbours = 9}), InvalidArgument);
  CHECK_THROWS_AS(fill_holes(image, {.rounds = -1}), InvalidArgument);
  CHECK_THROWS_AS(fill_holes(image, {.reach = -1}), InvalidArgument);
}

}  // namespace
}  // namespace rangezip
