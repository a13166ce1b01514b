#include "core/finish/local_sizes.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "tests/support/shapes.h"

namespace rangezip {
namespace {

constexpr double kSparse = 0.45;  // of the points' spacing; h is 1, that is 2.2 of these

/// A lattice of points in z = 0 over |x|, |y| <= 12, `times` as dense along each axis where x > 0.
PointGrid lattice(int times) {
  std::vector<Vec3> points;
  for (const double sign : {-1.0, 1.0}) {
    const double step = sign > 0.0 ? kSparse / times : kSparse;
    for (double x = 0.5 * step; x < 12.0; x += step) {
      for (double y = -12.0 + 0.5 * step; y < 12.0; y += step)
        points.emplace_back(sign * x, y, 0.0);
    }
  }
  return {points, {Vec3(-13.0), Vec3(13.0)}, 0.7};
}

/// The same square in triangles of side 1.
TriangleMesh square() {
  return shapes::square_sheet(24);
}

}  // namespace

TEST_CASE("where points are denser, triangles may be as much smaller", "[finish]") {
  for (const int times : {2, 3, 4}) {
    CAPTURE(times);
    const ShareField sizes = local_sizes(square(), lattice(times), 1.0, 0.0);
    for (double y = -9.0; y <= 9.0; y += 1.5) {
      CHECK(sizes.at({8.0, y, 0.0}) == Approx(2.2 * kSparse / times).epsilon(0.1));
      CHECK(sizes.at({-8.0, y, 0.0}) == 1.0);
    }
  }
}

TEST_CASE("triangles are no smaller than a quarter of a pixel or four times the noise",
          "[finish]") {
  CHECK(local_sizes(square(), lattice(9), 1.0, 0.0).at({8.0, 0.0, 0.0}) == 0.25);
  CHECK(local_sizes(square(), lattice(4), 1.0, 0.1).at({8.0, 0.0, 0.0}) == Approx(0.4));
}

TEST_CASE("sizes of an even cloud are all one, and of one that is only a little denser somewhere",
          "[finish]") {
  CHECK(local_sizes(square(), lattice(1), 1.0, 0.0).is_one());
  CHECK(local_sizes(square(), lattice(4), 1.0, 0.2).is_one());
  CHECK(local_sizes(square(), PointGrid({}, {Vec3(-1.0), Vec3(1.0)}, 0.7), 1.0, 0.0).is_one());
  CHECK(local_sizes({}, lattice(4), 1.0, 0.0).is_one());
}

}  // namespace rangezip
