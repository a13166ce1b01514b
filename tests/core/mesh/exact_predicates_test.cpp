#include "core/mesh/exact_predicates.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <random>

#include "tests/core/finish/shapes.h"

namespace rangezip {
namespace {

using testing::uniform;
__extension__ using Wide = __int128;

int sign_of(Wide value) {
  return value > 0 ? 1 : value < 0 ? -1 : 0;
}

/// Integer coordinates of 30 bits: determinants of three differences fit 128 bits.
struct Lattice {
  std::int64_t x, y, z;
};
Lattice lattice_point(std::mt19937_64& engine, std::int64_t range) {
  const auto c = [&] {
    return static_cast<std::int64_t>(uniform(engine, -1.0, 1.0) * static_cast<double>(range));
  };
  return {c(), c(), c()};
}
Vec3 scaled(const Lattice& p, double unit) {
  return Vec3(static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)) * unit;
}
Wide determinant(const Lattice& a, const Lattice& b, const Lattice& c, const Lattice& d) {
  const Wide ax = a.x - d.x, ay = a.y - d.y, az = a.z - d.z;
  const Wide bx = b.x - d.x, by = b.y - d.y, bz = b.z - d.z;
  const Wide cx = c.x - d.x, cy = c.y - d.y, cz = c.z - d.z;
  return az * (bx * cy - cx * by) + bz * (cx * ay - ax * cy) + cz * (ax * by - bx * ay);
}

TEST_CASE("orientation_3d agrees with integer determinants, nearly flat ones included") {
  std::mt19937_64 engine(1);
  for (int i = 0; i < 20000; ++i) {
    const Lattice a = lattice_point(engine, std::int64_t{1} << 30);
    const Lattice b = lattice_point(engine, std::int64_t{1} << 30);
    const Lattice c = lattice_point(engine, std::int64_t{1} << 30);
    Lattice d = lattice_point(engine, std::int64_t{1} << 30);
    if (i % 2 == 0) {  // next to the plane: rounding decides wrongly there
      const double s = uniform(engine, -1.0, 1.0), t = uniform(engine, -1.0, 1.0);
      const auto mix = [&](std::int64_t p, std::int64_t q, std::int64_t r) {
        return p + static_cast<std::int64_t>(s * static_cast<double>(q - p) +
                                             t * static_cast<double>(r - p));
      };
      d = {mix(a.x, b.x, c.x), mix(a.y, b.y, c.y), mix(a.z, b.z, c.z)};
      if (std::abs(d.x) > (1 << 30) || std::abs(d.y) > (1 << 30) || std::abs(d.z) > (1 << 30))
        continue;
    }
    CAPTURE(i);
    const double unit = std::ldexp(1.0, i % 41 - 20);
    REQUIRE(orientation_3d(scaled(a, unit), scaled(b, unit), scaled(c, unit), scaled(d, unit)) ==
            sign_of(determinant(a, b, c, d)));
  }
}

TEST_CASE("orientation_3d tells a point that is one ulp off a slanted plane") {
  // The plane x + y + z = 1.5 through points with few bits; 0.5 + 0.5 + 0.5 lies on it.
  const Vec3 a(1.5, 0.0, 0.0), b(0.0, 1.5, 0.0), c(0.0, 0.0, 1.5);
  const double half = 0.5;
  REQUIRE(orientation_3d(a, b, c, {half, half, half}) == 0);
  const double above = std::nextafter(half, 1.0), below = std::nextafter(half, 0.0);
  REQUIRE(orientation_3d(a, b, c, {half, half, above}) == -1);  // a, b, c turn left seen from it
  REQUIRE(orientation_3d(a, b, c, {half, half, below}) == 1);
  REQUIRE(orientation_3d(a, b, c, {above, half, below}) == -1);  // + 2 ulp and - 1 ulp
}

TEST_CASE("the sign follows permutations of the points") {
  std::mt19937_64 engine(2);
  for (int i = 0; i < 1000; ++i) {
    Vec3 p[4];
    for (Vec3& q : p)
      q = {uniform(engine, 0, 1), uniform(engine, 0, 1), uniform(engine, 0, 1)};
    if (i % 2 == 0) p[3] = p[0] + 0.3 * (p[1] - p[0]) + 0.4 * (p[2] - p[0]);
    const int sign = orientation_3d(p[0], p[1], p[2], p[3]);
    CAPTURE(i);
    REQUIRE(orientation_3d(p[1], p[2], p[0], p[3]) == sign);
    REQUIRE(orientation_3d(p[1], p[0], p[2], p[3]) == -sign);
    REQUIRE(orientation_3d(p[0], p[1], p[3], p[2]) == -sign);
  }
}

TEST_CASE("orientation_2d is exact on a line of doubles") {
  // Points i * (ulp, ulp) next to the line through (12, 12) and (24, 24) [Kettner et al. 2008]:
  // the floating-point evaluation is wrong for many of them.
  const double ulp = std::ldexp(1.0, -53);
  for (int i = 0; i < 64; ++i) {
    for (int j = 0; j < 64; ++j) {
      CAPTURE(i, j);
      const Vec2 p(0.5 + i * ulp, 0.5 + j * ulp);
      REQUIRE(p.x - 0.5 <= 64 * ulp);
      const int expected = p.y > p.x ? 1 : p.y < p.x ? -1 : 0;
      REQUIRE(orientation_2d({12.0, 12.0}, {24.0, 24.0}, p) == expected);
    }
  }
}

TEST_CASE("are_collinear needs all three projections") {
  REQUIRE(are_collinear({0, 0, 0}, {1, 2, 3}, {2, 4, 6}));
  REQUIRE(are_collinear({1, 2, 3}, {1, 2, 3}, {7, 8, 9}));
  REQUIRE_FALSE(are_collinear({0, 0, 0}, {1, 0, 0}, {2, 0, std::ldexp(1.0, -60)}));
  REQUIRE_FALSE(are_collinear({0, 0, 0}, {0, 1, 0}, {0, 2, std::ldexp(1.0, -60)}));
  REQUIRE_FALSE(are_collinear({0, 0, 0}, {1, 1, 0}, {2, std::nextafter(2.0, 3.0), 0}));
}

}  // namespace
}  // namespace rangezip
