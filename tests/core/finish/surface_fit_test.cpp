#include "core/finish/surface_fit.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

using testing::gaussian;
using testing::uniform;

constexpr double kRadius = 0.5;
const Box kRegion{Vec3(-2.0), Vec3(2.0)};

/// z = 0.03 + 0.1 x - 0.2 y + (k1 x^2 + 2 k12 x y + k2 y^2) / 2.
struct Quadric {
  double k1 = 0.3, k12 = -0.1, k2 = -0.5;

  [[nodiscard]] double height(double x, double y) const {
    return 0.03 + 0.1 * x - 0.2 * y + 0.5 * (k1 * x * x + 2.0 * k12 * x * y + k2 * y * y);
  }
};

std::vector<Vec3> points_of(const Quadric& quadric, std::size_t count, double noise,
                            std::mt19937_64& engine) {
  std::vector<Vec3> points(count);
  for (Vec3& p : points) {
    p.x = uniform(engine, -0.7, 0.7);
    p.y = uniform(engine, -0.7, 0.7);
    p.z = quadric.height(p.x, p.y) + noise * gaussian(engine);
  }
  return points;
}

TEST_CASE("the fit to points of a quadric is that quadric") {
  const std::uint64_t seed = GENERATE(1U, 2U, 3U);
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  const Quadric quadric;
  const PointGrid cloud(points_of(quadric, 400, 0.0, engine), kRegion, 0.2);
  const Vec3 z(0.0, 0.0, 1.0);
  const SurfaceFit fit = fit_surface(cloud, Vec3{0.0}, z, {kRadius, 1.0});
  REQUIRE(fit.is_found);
  // The grid stores floats of a region of size 4: 2.4e-7.
  REQUIRE(std::abs(fit.height - 0.03) < 1e-6);
  const double length = std::sqrt(1.0 + 0.01 + 0.04);
  REQUIRE(glm::length(fit.normal - Vec3(-0.1, 0.2, 1.0) / length) < 1e-5);
  const Vec3 x(1, 0, 0), y(0, 1, 0);
  REQUIRE(glm::dot(x, fit.bending * x) == Approx(quadric.k1 / length).margin(1e-4));
  REQUIRE(glm::dot(x, fit.bending * y) == Approx(quadric.k12 / length).margin(1e-4));
  REQUIRE(glm::dot(y, fit.bending * y) == Approx(quadric.k2 / length).margin(1e-4));
  REQUIRE(glm::length(fit.bending * z) < 1e-9);
}

TEST_CASE("places near the foot of a fit move onto its quadric, but for the third order") {
  const std::uint64_t seed = GENERATE(4U, 5U);
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  const Quadric quadric;
  const PointGrid cloud(points_of(quadric, 400, 0.0, engine), kRegion, 0.2);
  const SurfaceFit fit = fit_surface(cloud, Vec3{0.0}, {0.0, 0.0, 1.0}, {kRadius, 1.0});
  REQUIRE(glm::length(fit.foot - Vec3(0.0, 0.0, 0.03)) < 1e-6);
  REQUIRE(glm::length(projected_onto(fit, fit.foot) - fit.foot) < 1e-12);
  for (int i = 0; i < 100; ++i) {
    const double far = uniform(engine, 0.0, 0.2 * kRadius);
    const Vec3 direction{uniform(engine, -1, 1), uniform(engine, -1, 1),
                         uniform(engine, -0.2, 0.2)};
    const Vec3 onto = projected_onto(fit, fit.foot + far * glm::normalize(direction));
    REQUIRE(std::abs(onto.z - quadric.height(onto.x, onto.y)) < far * far * far + 1e-6);
  }
}

TEST_CASE("bending that noise may have made is taken back, the rest stays") {
  const std::uint64_t seed = GENERATE(11U, 12U, 13U, 14U);
  CAPTURE(seed);
  constexpr double kNoise = 0.02;
  const Vec3 z(0.0, 0.0, 1.0);
  const auto bending = [&](const Quadric& quadric, double told_noise) {
    std::mt19937_64 engine(seed);
    const PointGrid cloud(points_of(quadric, 400, kNoise, engine), kRegion, 0.2);
    const SurfaceFit fit = fit_surface(cloud, Vec3{0.0}, z, {kRadius, 1.0, told_noise});
    REQUIRE(fit.is_found);
    return fit.bending;
  };
  const auto size = [](const Mat3& m) {
    return std::sqrt(glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]));
  };
  const Quadric flat{0.0, 0.0, 0.0}, bent{6.0, 0.0, 6.0};
  REQUIRE(size(bending(flat, kNoise)) < 0.8 * size(bending(flat, 0.0)));
  REQUIRE(size(bending(bent, kNoise)) == Approx(size(bending(bent, 0.0))).epsilon(0.01));
}

TEST_CASE("noise and the variance of the height come out as they are") {
  std::mt19937_64 engine(4);
  constexpr double kNoise = 0.02;
  constexpr int kTrials = 400;
  double noise2 = 0.0, variance = 0.0, promised = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const PointGrid cloud(points_of({}, 80, kNoise, engine), kRegion, 0.2);
    const MeasuredFit measured = measure_surface(cloud, Vec3{0.0}, {0.0, 0.0, 1.0}, {kRadius, 1.0});
    REQUIRE(measured.fit.is_found);
    noise2 += measured.scatter.noise2 / kTrials;
    promised += kNoise * kNoise * measured.scatter.share2 / kTrials;
    variance += (measured.fit.height - 0.03) * (measured.fit.height - 0.03) / kTrials;
  }
  // Standard errors of 400 trials with about 25 degrees of freedom each: 1.4 %; of one: 7 %.
  REQUIRE(noise2 == Approx(kNoise * kNoise).epsilon(0.06));
  REQUIRE(variance == Approx(promised).epsilon(0.3));
}

TEST_CASE("few points give a plane, fewer nothing, and another sheet does not count") {
  std::mt19937_64 engine(5);
  const Quadric flat{0.0, 0.0, 0.0};
  const Vec3 z(0.0, 0.0, 1.0);
  const auto fit_of = [&](std::size_t count) {
    std::vector<Vec3> points;
    for (const Vec3& p : points_of(flat, 60, 0.0, engine)) {
      if (std::hypot(p.x, p.y) < kRadius && points.size() < count) points.push_back(p);
    }
    for (std::size_t i = 0; i < 40; ++i)
      points.push_back({uniform(engine, -0.5, 0.5), uniform(engine, -0.5, 0.5), -0.8});
    return fit_surface(PointGrid(points, kRegion, 0.2), Vec3{0.0}, z, {kRadius, 0.5});
  };
  REQUIRE_FALSE(fit_of(5).is_found);
  const SurfaceFit plane = fit_of(8);
  REQUIRE(plane.is_found);
  REQUIRE(plane.count == 8);
  REQUIRE(plane.bending == Mat3(0.0));
  REQUIRE(std::abs(plane.height - 0.03) < 1e-5);
  const SurfaceFit quadric = fit_of(20);
  REQUIRE(quadric.count == 20);
  REQUIRE(std::abs(quadric.height - 0.03) < 1e-5);
}

TEST_CASE("between contours the fit widens to those that tell how the surface bends") {
  // Rows of points on a cylinder, none within 0.3 of the place: two of them are in the window.
  const auto height = [](double y) { return -0.5 * y * y; };
  std::vector<Vec3> points;
  for (const double y : {-0.9, -0.6, -0.3, 0.3, 0.6, 0.9}) {
    for (int i = -100; i <= 100; ++i)
      points.emplace_back(0.01 * i, y, height(y));
  }
  const PointGrid cloud(points, kRegion, 0.2);
  const Vec3 z(0.0, 0.0, 1.0);
  // What lies between two rows is flat as far as they tell ...
  CHECK(fit_surface(cloud, Vec3{0.0}, z, {kRadius, 1.0}).height ==
        Approx(height(0.3)).epsilon(0.01));
  // ... and with those beyond them the cylinder.
  const SurfaceFit fit = fit_surface(cloud, Vec3{0.0}, z, {kRadius, 1.0, 0.0, 1.5});
  REQUIRE(fit.is_found);
  CHECK(std::abs(fit.height) < 1e-5);
  CHECK(fit.bending[1][1] == Approx(-1.0).epsilon(1e-3));
}

TEST_CASE("points in a row are no surface") {
  std::vector<Vec3> points;
  for (int i = -50; i <= 50; ++i)
    points.emplace_back(0.01 * i, 0.0, 0.0);
  const PointGrid cloud(points, kRegion, 0.2);
  REQUIRE_FALSE(fit_surface(cloud, Vec3{0.0}, {0.0, 0.0, 1.0}, {kRadius, 0.5}).is_found);
}

}  // namespace
}  // namespace rangezip
