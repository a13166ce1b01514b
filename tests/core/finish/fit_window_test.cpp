#include "core/finish/fit_window.h"

#include <catch2/catch.hpp>
#include <random>

#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

constexpr double kH = 0.05;

FitWindow window_for(double noise, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  const PointGrid cloud(testing::sphere_points(kH / 2.2, noise, engine), {Vec3(-1.5), Vec3(1.5)},
                        0.7 * kH);
  return choose_fit_window(testing::sphere(30), cloud, kH);
}

TEST_CASE("the noise of a cloud is found without being told") {
  const double noise = GENERATE(0.1, 0.25, 0.5) * kH;
  CAPTURE(noise);
  REQUIRE(window_for(noise, 1).noise == Approx(noise).epsilon(0.1));
}

TEST_CASE("the radius grows with the noise") {
  const FitWindow clean = window_for(0.0, 2), little = window_for(0.1 * kH, 2),
                  much = window_for(0.5 * kH, 2);
  REQUIRE(clean.noise < 0.01 * kH);
  REQUIRE(clean.window.radius < 2.0 * kH);
  REQUIRE(little.window.radius > clean.window.radius);
  REQUIRE(much.window.radius >= little.window.radius);
  REQUIRE(much.window.height > 3.0 * much.noise);
}

TEST_CASE("without points there is a window nevertheless") {
  const FitWindow fit =
      choose_fit_window(testing::sphere(8), PointGrid({}, {Vec3(-1.0), Vec3(1.0)}, 0.1), kH);
  REQUIRE(fit.noise == 0.0);
  REQUIRE(fit.window.radius > 0.0);
}

}  // namespace
}  // namespace rangezip
