#include "core/image/steep_cells.h"

#include <catch2/catch.hpp>

#include "core/base/error.h"
#include "tests/support/images.h"

namespace rangezip {
namespace {

TEST_CASE("mark_steep_cells marks planes steeper than the angle, whatever the direction",
          "[image]") {
  // min_cosine 0.2588 is 75 degrees: slopes beyond tan 75 = 3.732.
  for (const glm::dvec2 direction : {glm::dvec2{1, 0}, glm::dvec2{0, 1}, glm::dvec2{0.6, -0.8}}) {
    for (const double slope : {0.0, 3.6, 3.9}) {
      CAPTURE(direction.x, direction.y, slope);
      const RangeImage image = images::image_of(
          images::parallel_view({12, 12}, 1.0, 1000.0),
          [&](Pixel p) { return 100.0 + slope * (direction.x * p.x + direction.y * p.y); });
      const Mask steep = mark_steep_cells(image);
      CHECK(images::count_of(steep) == (slope > 3.732 ? 144U : 0U));
    }
  }
}

TEST_CASE("mark_steep_cells measures the angle to the line of sight under perspective", "[image]") {
  // The plane z = -10 from the origin: at window height v the ray leaves the axis by
  // tan = (v - 20) / 40, up to 0.49 here.
  const RangeImage image =
      images::image_of(images::central_view({40, 40}), [](Pixel) { return 10.0; });
  CHECK(images::count_of(mark_steep_cells(image, {.min_cosine = 0.8})) == 0);
  const Mask oblique = mark_steep_cells(image, {.min_cosine = 0.95});
  CHECK(oblique[{20, 20}] == 0);
  CHECK(oblique[{0, 0}] == 1);    // tan 0.69
  CHECK(oblique[{20, 1}] == 1);   // tan 0.46 is 24.7 degrees, cosine 0.908
  CHECK(oblique[{20, 10}] == 0);  // tan 0.24, cosine 0.97
}

TEST_CASE("mark_steep_cells spares the rim of a flat piece and lone samples", "[image]") {
  const RangeImage image = images::image_of(images::parallel_view({12, 12}), [](Pixel p) {
    if (p.x == 11) return p.y == 5 ? 10.0 : kNoSample;
    return p.x < 5 ? 10.0 : p.x < 9 ? 40.0 : kNoSample;
  });
  // Every sample is part of a level cell on its side of the step, or of no cell.
  CHECK(images::count_of(mark_steep_cells(image)) == 0);
}

TEST_CASE("mark_steep_cells refuses a cosine out of range", "[image]") {
  const RangeImage image(images::parallel_view({3, 3}));
  CHECK_THROWS_AS(mark_steep_cells(image, {.min_cosine = 0.0}), InvalidArgument);
  CHECK_THROWS_AS(mark_steep_cells(image, {.min_cosine = 1.5}), InvalidArgument);
}

}  // namespace
}  // namespace rangezip
