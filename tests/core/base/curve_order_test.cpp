#include "core/base/curve_order.h"

#include <catch2/catch.hpp>
#include <random>

namespace rangezip {
namespace {

TEST_CASE("The order along a curve is the same for floats and for the doubles that equal them") {
  constexpr std::uint32_t kSeed = 9;
  CAPTURE(kSeed);
  std::mt19937 engine(kSeed);
  const auto uniform = [&] { return static_cast<float>(engine() >> 8U) * 0x1p-24F; };
  std::vector<Vec3f> places;
  for (int i = 0; i < 5000; ++i) {
    const float x = uniform(), y = uniform();
    places.emplace_back(x, y, uniform());
  }
  const std::vector<Vec3> doubles(places.begin(), places.end());
  CHECK(order_along_curve(places) == order_along_curve(doubles));
}

TEST_CASE("Places that differ by less than a float can tell are ordered") {
  // As in UTM coordinates: floats there are half a metre apart.
  const Vec3 far(4e5, 5e6, 0.0);
  const std::vector<Vec3> places{far + Vec3(0.3, 0, 0), far, far + Vec3(0.1, 0, 0)};
  CHECK(order_along_curve(places) == std::vector<std::uint32_t>{1, 2, 0});
  CHECK(order_along_curve(std::vector<Vec3>{}).empty());
}

}  // namespace
}  // namespace rangezip
