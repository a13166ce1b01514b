#include "core/base/deterministic_math.h"

#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <catch2/catch.hpp>

#include "tests/support/shapes.h"

namespace rangezip {
namespace {

constexpr double kHalfPi = 0x1.921fb54442d18p+0;

/// How far the tangent is from the C library's, in units of the last place of that.
double units_off(double angle) {
  const double expected = std::tan(angle);
  const double unit = std::nextafter(expected, std::numeric_limits<double>::infinity()) - expected;
  return std::abs(deterministic_tan(angle) - expected) / unit;
}

TEST_CASE("deterministic_tan is the tangent", "[base]") {
  // Ours is at most 2 units off, good C libraries at most 1; the rest is room for worse ones.
  constexpr double kUnits = 4.0;
  constexpr int kSteps = 200'000;
  double most = 0.0;
  for (int i = 1; i < kSteps; ++i)
    most = std::max(most, units_off(kHalfPi * i / kSteps));
  CHECK(most <= kUnits);
  // As close to the ends as doubles get, and on both sides of the seam at pi / 4.
  for (int exponent = 1; exponent <= 52; ++exponent) {
    CAPTURE(exponent);
    CHECK(units_off(std::ldexp(1.0, -exponent)) <= kUnits);
    CHECK(units_off(kHalfPi - std::ldexp(1.0, -exponent)) <= kUnits);
    CHECK(units_off(0.5 * kHalfPi - std::ldexp(1.0, -exponent)) <= kUnits);
    CHECK(units_off(0.5 * kHalfPi + std::ldexp(1.0, -exponent)) <= kUnits);
  }
}

TEST_CASE("deterministic_tan grows with the angle", "[base]") {
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    CAPTURE(seed);
    shapes::Random random(seed);
    const double angle = random.between(0.0, kHalfPi - 1e-6);
    CHECK(deterministic_tan(angle) < deterministic_tan(angle + 1e-9));
  }
}

TEST_CASE("deterministic_tan has the same bits on every machine", "[base]") {
  CHECK(deterministic_tan(0.0) == 0.0);
  constexpr std::array<std::pair<double, double>, 12> kKnown{{
      {0x1p-1000, 0x1p-1000},
      {0x1p-30, 0x1p-30},
      {0x1.999999999999ap-4, 0x1.9af8877430b8p-4},
      {0x1.921fb54442d17p-2, 0x1.a827999fcef31p-2},
      {0x1p-1, 0x1.17b4f5bf3474ap-1},
      {0x1.6666666666666p-1, 0x1.af406c2fc78aep-1},
      {0x1.921fb54442d18p-1, 0x1p+0},
      {0x1.999999999999ap-1, 0x1.079664793b60bp+0},
      {0x1p+0, 0x1.8eb245cbee3a5p+0},
      {0x1.4cccccccccccdp+0, 0x1.cd11b1696e97ep+1},
      {0x1.91eb851eb851fp+0, 0x1.39f0ff737e7f2p+10},
      {0x1.921fb54442d17p+0, 0x1.9153d9443ed0bp+51},
  }};
  for (const auto& [angle, tangent] : kKnown) {
    CAPTURE(angle);
    CHECK(deterministic_tan(angle) == tangent);
  }
}

}  // namespace
}  // namespace rangezip
