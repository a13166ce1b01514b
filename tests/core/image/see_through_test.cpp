#include "core/image/see_through.h"

#include <catch2/catch.hpp>

#include "core/base/error.h"
#include "tests/support/images.h"

namespace rangezip {
namespace {

TEST_CASE("remove_see_through takes the back seen through gaps of the front", "[image]") {
  // The front at 10; a tenth of the pixels show the back at 30.
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    shapes::Random random(seed);
    const RangeImage image = images::image_of(images::parallel_view({40, 40}), [&](Pixel) {
      return random.bits() % 10 == 0 ? 30.0 : 10.0;
    });
    const SeeThroughResult result = remove_see_through(image);
    std::size_t front = 0;
    for (int y = 0; y < 40; ++y) {
      for (int x = 0; x < 40; ++x) {
        REQUIRE(result.image[{x, y}] != 30.0);
        // At the border of the image a sample may have too few neighbours to be believed.
        const bool is_inner = x > 1 && x < 38 && y > 1 && y < 38;
        if (is_inner && image[{x, y}] == 10.0) REQUIRE(result.image.has_sample({x, y}));
        front += result.image.has_sample({x, y}) ? 1 : 0;
      }
    }
    REQUIRE(result.removed == 1600 - front);
  }
}

TEST_CASE("remove_see_through keeps planes up to the slope it allows", "[image]") {
  for (const double slope : {0.0, 1.0, 2.0, 2.9}) {
    CAPTURE(slope);
    const RangeImage image = images::image_of(images::parallel_view({20, 20}, 1.0, 1000.0),
                                              [&](Pixel p) { return 10.0 + slope * p.x; });
    CHECK(remove_see_through(image).image == image);
    CHECK(remove_see_through(image).removed == 0);
  }
}

TEST_CASE("remove_see_through keeps both sides of a silhouette", "[image]") {
  const RangeImage image = images::image_of(images::parallel_view({20, 20}),
                                            [](Pixel p) { return p.x < 9 ? 10.0 : 40.0; });
  CHECK(remove_see_through(image).image == image);
}

TEST_CASE("remove_see_through takes lone outliers only if asked", "[image]") {
  RangeImage image = images::image_of(images::parallel_view({20, 20}), [](Pixel) { return 30.0; });
  const RangeImage clean = image;
  image[{10, 10}] = 5.0;  // floats before the sheet
  const SeeThroughResult result = remove_see_through(image);
  CHECK(result.removed == 1);
  CHECK_FALSE(result.image.has_sample({10, 10}));
  CHECK(remove_see_through(image, {.remove_outliers = false}).image == image);
  CHECK(remove_see_through(image, {.rounds = 0}).image == image);
  CHECK(remove_see_through(clean).image == clean);
}

TEST_CASE("remove_see_through of a mirrored image is the mirrored result", "[image]") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    const RangeImage image = images::rough_image({41, 30}, seed);
    REQUIRE(remove_see_through(images::mirrored(image), {.max_slope = 0.7}).image ==
            images::mirrored(remove_see_through(image, {.max_slope = 0.7}).image));
  }
}

TEST_CASE("remove_see_through refuses impossible options", "[image]") {
  const RangeImage image(images::parallel_view({3, 3}));
  CHECK_THROWS_AS(remove_see_through(image, {.max_slope = 0.0}), InvalidArgument);
  CHECK_THROWS_AS(remove_see_through(image, {.rounds = -1}), InvalidArgument);
}

}  // namespace
}  // namespace rangezip
