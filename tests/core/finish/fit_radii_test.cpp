#include "core/finish/fit_radii.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "core/finish/fit_window.h"
#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

constexpr double kH = 0.05;
constexpr double kNoise = 0.3 * kH;
constexpr double kHalf = 2.0;  // of the side of the sheet

/// A sheet that is flat where x < 0 and has waves beyond.
double height_at(double x) {
  return x < 0.0 ? 0.0 : 2.0 * kNoise * std::sin(x / kH);
}

PointGrid noisy_sheet(std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal(0.0, kNoise);
  std::vector<Vec3> points(30'000);
  for (Vec3& p : points) {
    p.x = testing::uniform(engine, -kHalf, kHalf);
    p.y = testing::uniform(engine, -kHalf, kHalf);
    p.z = height_at(p.x) + normal(engine);
  }
  return {points, {Vec3(-2.0 * kHalf), Vec3(2.0 * kHalf)}, 0.7 * kH};
}

TriangleMesh sheet() {
  constexpr std::uint32_t kSide = 120;
  TriangleMesh mesh;
  for (std::uint32_t y = 0; y <= kSide; ++y) {
    for (std::uint32_t x = 0; x <= kSide; ++x) {
      const Vec2 p = Vec2(x, y) * (2.0 * kHalf / kSide) - Vec2(kHalf);
      mesh.positions.emplace_back(p.x, p.y, height_at(p.x));
    }
  }
  for (std::uint32_t y = 0; y < kSide; ++y) {
    for (std::uint32_t x = 0; x < kSide; ++x) {
      const std::uint32_t a = y * (kSide + 1) + x, b = a + kSide + 1;
      mesh.triangles.push_back({a, a + 1, b + 1});
      mesh.triangles.push_back({a, b + 1, b});
    }
  }
  return mesh;
}

SurfaceWindow window() {
  return {.radius = 5.0 * kH, .height = 4.0 * kNoise, .noise = kNoise};
}

/// Mean square distance of fits from the sheet where the sign of x is as given.
double error_of(const PointGrid& cloud, const FitWindow& fit, double sign) {
  double sum = 0.0;
  int count = 0;
  for (double x = 0.2; x < 0.8 * kHalf; x += 0.03) {
    for (double y = -0.8 * kHalf; y < 0.8 * kHalf; y += 0.3) {
      const Vec3 place{sign * x, y, height_at(sign * x)};
      const SurfaceFit found = fit_surface(cloud, place, {0, 0, 1}, fit.at(place));
      REQUIRE(found.is_found);
      sum += found.height * found.height;
      ++count;
    }
  }
  return sum / count;
}

TEST_CASE("windows are wide where the surface is even and narrow where it is not") {
  const std::uint64_t seed = GENERATE(std::uint64_t{1}, std::uint64_t{2}, std::uint64_t{3});
  CAPTURE(seed);
  const ShareField radii = local_fit_radii(sheet(), noisy_sheet(seed), window(), kH);
  for (double y = -1.0; y <= 1.0; y += 0.25) {
    REQUIRE(radii.at({-1.0, y, 0.0}) > 1.2);
    REQUIRE(radii.at({1.0, y, 0.0}) < 0.8);
  }
}

TEST_CASE("with windows of their own, fits are closer to even and to bent surface") {
  const PointGrid cloud = noisy_sheet(4);
  const FitWindow same{window(), kNoise, {}};
  const FitWindow own{window(), kNoise, local_fit_radii(sheet(), cloud, window(), kH)};
  REQUIRE(error_of(cloud, own, -1.0) < 0.6 * error_of(cloud, same, -1.0));
  REQUIRE(error_of(cloud, own, 1.0) < 0.6 * error_of(cloud, same, 1.0));
}

TEST_CASE("fit_covariance() says how much of the noise a narrow and a wide fit have in common") {
  const std::uint64_t seed = 5;
  const PointGrid cloud = noisy_sheet(seed);
  SurfaceWindow narrow = window(), wide = window();
  narrow.radius = 2.0 * kH;
  wide.radius = 4.0 * kH;
  double product = 0.0, square = 0.0;
  for (double x = -0.9 * kHalf; x < -0.3; x += 0.05) {
    for (double y = -0.9 * kHalf; y < 0.9 * kHalf; y += 0.05) {
      const MeasuredFit a = measure_surface(cloud, {x, y, 0.0}, {0, 0, 1}, narrow);
      const MeasuredFit b = measure_surface(cloud, {x, y, 0.0}, {0, 0, 1}, wide);
      product += a.fit.height * b.fit.height;
      square += b.fit.height * b.fit.height;
    }
  }
  REQUIRE(product / square == Approx(fit_covariance(2.0 * kH, 4.0 * kH)).epsilon(0.1));
  REQUIRE(fit_covariance(kH, kH) == Approx(1.0));
}

TEST_CASE("without points all windows stay") {
  const ShareField radii =
      local_fit_radii(sheet(), PointGrid({}, {Vec3(-1.0), Vec3(1.0)}, 0.1), window(), kH);
  REQUIRE(radii.at({0.5, 0.5, 0.0}) == 1.0);
}

}  // namespace
}  // namespace rangezip
