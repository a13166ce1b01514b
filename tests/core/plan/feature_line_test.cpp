#include "core/plan/feature_line.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/images.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

using images::central_view;
using images::image_of;
using images::parallel_view;

/// Two planes that meet over a line of the image.
struct Roof {
  Vec2 normal;
  double offset = 0.0;
  double bend = 0.0;  ///< change of slope
  glm::dvec2 slope{0.0, 0.0};

  [[nodiscard]] double depth(const Vec2& window) const {
    const double beyond = glm::dot(normal, window) - offset;
    return 80.0 + glm::dot(slope, window) + bend * std::max(0.0, beyond);
  }
};

constexpr Extent kImage{150, 120};

Roof random_roof(shapes::Random& random) {
  const double angle = random.between(0.0, 2.0 * std::acos(-1.0));
  const Vec2 normal{std::cos(angle), std::sin(angle)};
  const Vec2 place{random.between(50.0, 100.0), random.between(40.0, 80.0)};
  const double sign = random.bits() % 2 == 0 ? 1.0 : -1.0;
  return {.normal = normal,
          .offset = glm::dot(normal, place),
          .bend = sign * random.between(0.5, 2.0),
          .slope = {random.between(-0.3, 0.3), random.between(-0.3, 0.3)}};
}

/// The largest distance of the found line from the real one within the image, pixels.
double deviation(const FeatureLine& found, const Roof& roof) {
  const Vec2 along{-roof.normal.y, roof.normal.x};
  const Vec2 middle{0.5 * kImage.width, 0.5 * kImage.height};
  const Vec2 foot = middle + (roof.offset - glm::dot(roof.normal, middle)) * roof.normal;
  double largest = 0.0;
  for (const double way : {-60.0, 0.0, 60.0}) {
    const Vec2 place = foot + way * along;
    largest = std::max(largest, std::abs(glm::dot(found.normal, place) - found.offset));
  }
  return largest;
}

TEST_CASE("the ridge of a roof is found to a fiftieth of a pixel", "[feature_line]") {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    CAPTURE(seed);
    shapes::Random random(seed);
    const Roof roof = random_roof(random);
    const RangeImage image = image_of(parallel_view(kImage, 1.0, 900.0), [&](Pixel p) {
      return roof.depth({p.x + 0.5, p.y + 0.5});
    });
    const auto line = find_feature_line(image);
    REQUIRE(line.has_value());
    REQUIRE(deviation(*line, roof) < 1e-6);  // the planes are exact
    REQUIRE(line->length >= 40.0);

    // Noise of a fiftieth of a pixel in depth.
    const RangeImage noisy =
        image_of(image.view(), [&](Pixel p) { return image[p] + 0.02 * random.normal(); });
    const auto rough = find_feature_line(noisy);
    REQUIRE(rough.has_value());
    REQUIRE(deviation(*rough, roof) < 0.02);
  }
}

TEST_CASE("the ridge of a roof is found in a central projection", "[feature_line]") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    shapes::Random random(seed);
    Roof roof = random_roof(random);
    // Planes are linear in the inverse of the depth, of a ridge toward the viewer.
    const View view = central_view(kImage);
    const RangeImage image = image_of(view, [&](Pixel p) {
      const Vec2 place{p.x + 0.5, p.y + 0.5};
      const double beyond = glm::dot(roof.normal, place) - roof.offset;
      return 30.0 / (1.0 + 0.01 * std::abs(roof.bend * beyond) + 0.001 * (p.x - 75.0));
    });
    const auto line = find_feature_line(image);
    REQUIRE(line.has_value());
    REQUIRE(deviation(*line, roof) < 1e-6);
  }
}

TEST_CASE("of several ridges the sharper and the longer one is found", "[feature_line]") {
  const RangeImage image = image_of(parallel_view(kImage, 1.0, 900.0), [](Pixel p) {
    const double flat = 0.6 * std::max(0.0, p.x - 40.25);
    return 80.0 + flat + 1.2 * std::max(0.0, p.y - 70.75 + 0.1 * p.x);
  });
  const auto line = find_feature_line(image);
  REQUIRE(line.has_value());
  REQUIRE(std::abs(line->normal.y) > 0.99);
}

TEST_CASE("neither a step of depth nor a smooth bend is a feature line", "[feature_line]") {
  const RangeImage step = image_of(parallel_view(kImage, 1.0, 900.0), [](Pixel p) {
    return p.x + 0.3 * p.y < 70.0 ? 20.0 : 32.0 + 0.2 * p.x;
  });
  CHECK_FALSE(find_feature_line(step).has_value());
  const RangeImage ball = image_of(parallel_view(kImage, 1.0, 900.0), [](Pixel p) {
    return 200.0 -
           std::sqrt(120.0 * 120.0 - (p.x - 75.0) * (p.x - 75.0) - (p.y - 60.0) * (p.y - 60.0));
  });
  CHECK_FALSE(find_feature_line(ball).has_value());
  CHECK_FALSE(find_feature_line(RangeImage(parallel_view(kImage))).has_value());
}

}  // namespace
}  // namespace rangezip
