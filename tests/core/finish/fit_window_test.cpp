#include "core/finish/fit_window.h"

#include <catch2/catch.hpp>
#include <random>
#include <vector>

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

TEST_CASE("one place where a narrow fit finds another sheet does not narrow all windows") {
  const TriangleMesh mesh = testing::sphere(30);
  const auto window_with = [&](bool has_patch) {
    std::mt19937_64 engine(3);
    std::vector<Vec3> points = testing::sphere_points(kH / 2.2, 0.03 * kH, engine);
    const Vec3 place = mesh.positions[0];
    if (has_patch) {  // narrower than the wide fits, and denser
      std::erase_if(points, [&](const Vec3& p) { return glm::length(p - place) < 0.9 * kH; });
      for (int i = 0; i < 100; ++i) {
        Vec3 p = place + 0.5 * kH * testing::direction(engine);
        points.push_back(p * ((1.0 + 0.8 * kH) / glm::length(p)));
      }
    }
    const PointGrid cloud(points, {Vec3(-1.5), Vec3(1.5)}, 0.7 * kH);
    return choose_fit_window(mesh, cloud, kH).window.radius;
  };
  REQUIRE(window_with(true) == window_with(false));
}

TEST_CASE(
    "of two scans out of place, which err alike everywhere, the widest window is as good as any") {
  std::mt19937_64 engine(4);
  constexpr double kOutOfPlace = 0.15 * kH;
  std::vector<Vec3> points;
  for (const Vec3& p : testing::sphere_points(kH / 1.6, 0.0, engine)) {
    points.push_back(p * (1.0 + kOutOfPlace));
    points.push_back(p * (1.0 - kOutOfPlace));
  }
  const PointGrid cloud(points, {Vec3(-1.5), Vec3(1.5)}, 0.7 * kH);
  const FitWindow fit = choose_fit_window(testing::sphere(30), cloud, kH);
  REQUIRE(fit.noise == Approx(kOutOfPlace).epsilon(0.2));
  REQUIRE(fit.window.radius > 4.0 * kH);
}

TEST_CASE("without points there is a window nevertheless") {
  const FitWindow fit =
      choose_fit_window(testing::sphere(8), PointGrid({}, {Vec3(-1.0), Vec3(1.0)}, 0.1), kH);
  REQUIRE(fit.noise == 0.0);
  REQUIRE(fit.window.radius > 0.0);
}

}  // namespace
}  // namespace rangezip
