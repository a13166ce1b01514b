#include "core/base/sphere_set.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>
#include <vector>

namespace rangezip {
namespace {

TEST_CASE("a set of spheres holds the points that one of them holds", "[base]") {
  const std::uint64_t seed = GENERATE(range(std::uint64_t{1}, std::uint64_t{9}));
  CAPTURE(seed);
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> place(-10.0, 10.0), size(0.01, 1.5);
  std::vector<Sphere> spheres(60);
  for (Sphere& sphere : spheres)
    sphere = {{place(engine), place(engine), place(engine)}, size(engine)};
  const SphereSet set(spheres);
  int inside = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Vec3 point{1.3 * place(engine), 1.3 * place(engine), 1.3 * place(engine)};
    const bool is_in_one = std::any_of(spheres.begin(), spheres.end(),
                                       [&](const Sphere& s) { return s.contains(point); });
    REQUIRE(set.contains(point) == is_in_one);
    inside += is_in_one ? 1 : 0;
  }
  CHECK(inside > 100);
}

TEST_CASE("spheres that touch the sides of cubes, and far ones, are found", "[base]") {
  const std::vector<Sphere> spheres{{{1.0, 1.0, 1.0}, 1.0}, {{1e15, 0.0, 0.0}, 1e-3}};
  const SphereSet set(spheres);
  CHECK(set.contains({2.0, 1.0, 1.0}));
  CHECK(set.contains({0.0, 1.0, 1.0}));
  CHECK(set.contains({1e15, 0.0, 0.0}));
  CHECK_FALSE(set.contains({2.1, 1.0, 1.0}));
  CHECK_FALSE(set.contains({-1e300, 1.0, 1.0}));
  CHECK_FALSE(SphereSet({}).contains({0.0, 0.0, 0.0}));
}

}  // namespace
}  // namespace rangezip
