#include "core/plan/unseen_samples.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <initializer_list>
#include <limits>
#include <memory>

#include "core/base/error.h"
#include "core/plan/spacing.h"
#include "raster_cpu/cpu_rasterizer.h"
#include "tests/support/shapes.h"

namespace rangezip {
namespace {

constexpr double kPixel = 0.05;
/// Something far from the origin is told apart as well.
const Vec3 kMiddle{4000.0, -7000.0, 900.0};

Scene spheres(std::initializer_list<double> radii) {
  Scene scene;
  Mat4 placement(1.0);
  placement[3] = Vec4(kMiddle, 1.0);
  for (const double radius : radii)
    scene.add(std::make_shared<const TriangleSoup>(shapes::sphere(radius)), placement);
  return scene;
}

TEST_CASE("of a sphere within a sphere no sample is seen, and all of the outer one are") {
  const double inner = GENERATE(0.5, 0.9, 1.0 - 0.4 * kPixel);
  CAPTURE(inner);
  const Scene scene = spheres({1.0, inner});
  const std::vector<Vec3> samples = area_samples(scene, 30'000);
  CpuRasterizer rasterizer;
  const std::vector<std::uint8_t> is_unseen = unseen_samples(rasterizer, scene, samples, kPixel);
  REQUIRE(is_unseen.size() == samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const bool is_inner = glm::distance(samples[i], kMiddle) < 0.5 * (1.0 + inner);
    CHECK(is_unseen[i] == (is_inner ? 1 : 0));
  }
}

TEST_CASE("all samples of a single surface are seen, on whichever side") {
  CpuRasterizer rasterizer;
  for (const TriangleSoup& soup : {shapes::cube(), shapes::washer()}) {
    Scene scene;
    scene.add(std::make_shared<const TriangleSoup>(soup));
    const std::vector<std::uint8_t> is_unseen =
        unseen_samples(rasterizer, scene, area_samples(scene, 20'000), kPixel);
    CHECK(std::count(is_unseen.begin(), is_unseen.end(), 1) == 0);
  }
}

TEST_CASE("unseen_samples needs a pixel size, and no samples") {
  CpuRasterizer rasterizer;
  const Scene scene = spheres({1.0});
  CHECK(unseen_samples(rasterizer, scene, {}, kPixel).empty());
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity()})
    CHECK_THROWS_AS(unseen_samples(rasterizer, scene, {}, bad), InvalidArgument);
}

}  // namespace
}  // namespace rangezip
