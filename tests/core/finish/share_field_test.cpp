#include "core/finish/share_field.h"

#include <catch2/catch.hpp>

namespace rangezip {

TEST_CASE("shares are linear between the centres of cubes, and 1 away from them") {
  const ShareField shares(2.0, {{0, 0, 0}, {1, 0, 0}}, {0.5, 1.5});
  REQUIRE(shares.at({1.0, 1.0, 1.0}) == Approx(0.5));
  REQUIRE(shares.at({3.0, 1.0, 1.0}) == Approx(1.5));
  REQUIRE(shares.at({1.5, 1.0, 1.0}) == Approx(0.75));
  REQUIRE(shares.at({2.5, 1.9, 0.2}) == Approx(1.25));
  REQUIRE(shares.at({20.0, 1.0, 1.0}) == 1.0);
  REQUIRE(ShareField().at({1.0, 1.0, 1.0}) == 1.0);
}

}  // namespace rangezip
