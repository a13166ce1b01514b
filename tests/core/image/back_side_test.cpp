#include "core/image/back_side.h"

#include <catch2/catch.hpp>

#include "tests/support/images.h"

namespace rangezip {
namespace {

TEST_CASE("remove_back_side takes what lies behind the largest gap of the depths", "[image]") {
  // A sheet at 10..11, every ninth pixel shows the back at 20..21.
  const Extent extent{30, 30};
  const RangeImage image = images::image_of(images::parallel_view(extent), [&](Pixel p) {
    const double ramp = static_cast<double>(extent.index(p)) / 900.0;
    return (extent.index(p) % 9 == 0 ? 20.0 : 10.0) + ramp;
  });
  const BackSideResult result = remove_back_side(image);
  CHECK(result.removed == 100);
  CHECK(images::sample_count(result.image) == 800);
  CHECK(result.threshold < 11.0);
  CHECK(result.gap > 9.0);
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 30; ++x) {
      const Pixel p{x, y};
      REQUIRE(result.image[p] == (extent.index(p) % 9 == 0 ? kNoSample : image[p]));
    }
  }
}

TEST_CASE("remove_back_side without a back side only touches the far end of the depths",
          "[image]") {
  const Extent extent{20, 20};
  // A ramp with equal steps but for the last one.
  const RangeImage image = images::image_of(images::parallel_view(extent), [&](Pixel p) {
    return 1.0 + static_cast<double>(extent.index(p)) / 64.0 + (p.x + p.y == 38 ? 1.0 / 32.0 : 0);
  });
  CHECK(remove_back_side(image).removed == 1);
}

TEST_CASE("remove_back_side spares gaps below min_gap and level images", "[image]") {
  const Extent extent{4, 4};
  const RangeImage steps = images::image_of(images::parallel_view(extent),
                                            [](Pixel p) { return p.x < 2 ? 10.0 : 12.0; });
  CHECK(remove_back_side(steps, {.min_gap = 2.5}).removed == 0);
  CHECK(remove_back_side(steps, {.min_gap = 2.5}).image == steps);
  CHECK(remove_back_side(steps, {.min_gap = 2.0}).removed == 8);

  const RangeImage level =
      images::image_of(images::parallel_view(extent), [](Pixel) { return 10.0; });
  CHECK(remove_back_side(level).image == level);
  const RangeImage empty(images::parallel_view(extent));
  CHECK(remove_back_side(empty).image == empty);
  CHECK(remove_back_side(empty).threshold == kNoSample);
}

}  // namespace
}  // namespace rangezip
