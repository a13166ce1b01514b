#include "core/image/median_filter.h"

#include <catch2/catch.hpp>

#include "core/base/error.h"
#include "tests/support/images.h"

namespace rangezip {
namespace {

TEST_CASE("median_filter keeps a step of depth", "[image]") {
  const RangeImage image = images::image_of(images::parallel_view({20, 12}),
                                            [](Pixel p) { return p.x < 9 ? 10.0 : 30.0; });
  CHECK(median_filter(image) == image);
  CHECK(median_filter(image, {.radius = 3}) == image);
}

TEST_CASE("median_filter keeps a tilted plane up to its border", "[image]") {
  const RangeImage image = images::image_of(images::parallel_view({20, 12}), [](Pixel p) {
    const bool is_outside = p.x < 3 || p.y < 2 || (p.x == 10 && p.y == 6);
    return is_outside ? kNoSample : 10.0 + 0.5 * p.x - 0.25 * p.y;
  });
  CHECK(median_filter(image) == image);
  CHECK(median_filter(image, {.radius = 2}) == image);
}

TEST_CASE("median_filter removes single spikes", "[image]") {
  RangeImage image = images::image_of(images::parallel_view({20, 12}), [](Pixel) { return 10.0; });
  const RangeImage clean = image;
  image[{5, 5}] = 12.0;
  image[{12, 7}] = 8.5;
  CHECK(median_filter(image) == clean);
}

TEST_CASE("median_filter makes noise smaller and never makes or removes a sample", "[image]") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    shapes::Random random(seed);
    const RangeImage image = images::image_of(images::parallel_view({40, 40}), [&](Pixel) {
      return random.bits() % 10 == 0 ? kNoSample : 10.0 + random.normal() * 0.3;
    });
    const RangeImage filtered = median_filter(image);
    double before = 0.0;
    double after = 0.0;
    for (std::size_t i = 0; i < image.depth().pixels().size(); ++i) {
      const double raw = image.depth().pixels()[i];
      const double smooth = filtered.depth().pixels()[i];
      REQUIRE((raw == kNoSample) == (smooth == kNoSample));
      if (raw == kNoSample) continue;
      before += (raw - 10.0) * (raw - 10.0);
      after += (smooth - 10.0) * (smooth - 10.0);
    }
    // The median of 5 or more normal values has less than 0.29 of their variance.
    REQUIRE(after < 0.4 * before);
  }
}

TEST_CASE("median_filter of a mirrored image is the mirrored result", "[image]") {
  const RangeImage image = images::rough_image({41, 30}, 3);
  CHECK(median_filter(images::mirrored(image)) == images::mirrored(median_filter(image)));
}

TEST_CASE("median_filter refuses impossible options", "[image]") {
  const RangeImage image(images::parallel_view({3, 3}));
  CHECK_THROWS_AS(median_filter(image, {.radius = 0}), InvalidArgument);
  CHECK_THROWS_AS(median_filter(image, {.radius = 51}), InvalidArgument);
  CHECK_THROWS_AS(median_filter(image, {.radius = 1, .max_step = 0.0}), InvalidArgument);
}

}  // namespace
}  // namespace rangezip
