#include "core/base/check_number.h"

#include <limits>
#include <string>

#include <catch2/catch.hpp>

#include "core/base/error.h"

namespace rangezip {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST_CASE("a number within the rule passes, and one beside it is refused with name, rule and value",
          "[base]") {
  CHECK_NOTHROW(check_not_negative("f: x", 0.0));
  CHECK_NOTHROW(check_positive("f: x", std::numeric_limits<double>::denorm_min()));
  CHECK_NOTHROW(check_range("f: x", 1.0, 1.0, 2.0));
  CHECK_NOTHROW(check_range("f: x", 2.0, 1.0, 2.0));
  CHECK_THROWS_WITH(check_not_negative("f: x", -1.0),
                    Catch::StartsWith("f: x must be finite and not negative, got -1.0"));
  CHECK_THROWS_WITH(check_positive("f: x", 0.0),
                    Catch::StartsWith("f: x must be positive and finite, got 0.0"));
  CHECK_THROWS_WITH(check_range("f: x", 2.5, 1.0, 2.0), Catch::Contains("got 2.5"));
}

TEST_CASE("what is no finite number is refused by every rule", "[base]") {
  for (const double value : {kNan, kInfinity, -kInfinity}) {
    CAPTURE(value);
    CHECK_THROWS_AS(check_not_negative("x", value), InvalidArgument);
    CHECK_THROWS_AS(check_positive("x", value), InvalidArgument);
    CHECK_THROWS_AS(check_range("x", value, 0.0, 1.0), InvalidArgument);
  }
}

}  // namespace
}  // namespace rangezip
