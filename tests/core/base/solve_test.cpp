#include "core/base/solve.h"

#include <catch2/catch.hpp>

namespace rangezip {
namespace {

TEST_CASE("solve undoes a product, and tells what has too small a determinant", "[base]") {
  const Mat3 m({4, 1, 0}, {1, 3, -1}, {0, -1, 2});  // its determinant is 18
  const Vec3 x{1, -2, 5};
  const std::optional<Vec3> solution = solve(m, m * x, 17.9);
  REQUIRE(solution);
  CHECK(glm::length(*solution - x) < 1e-14);
  CHECK(!solve(m, m * x, 18.1));
  CHECK(!solve(Mat3({1, 0, 0}, {0, 1, 0}, {1, 1, 0}), x, 0.0));
}

}  // namespace
}  // namespace rangezip
