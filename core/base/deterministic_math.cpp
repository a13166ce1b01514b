#include "core/base/deterministic_math.h"

namespace rangezip {

namespace {

constexpr double kQuarterPi = 0x1.921fb54442d18p-1;
// pi / 2 as the sum of two doubles.
constexpr double kHalfPi = 0x1.921fb54442d18p+0;
constexpr double kHalfPiRest = 0x1.1a62633145c07p-54;

/// The g of tan(x) = x / (1 - x^2 / g) in Lambert's continued fraction: 3 - x^2 / (5 - x^2 / ...).
/// @pre 0 <= squared <= (pi / 4)^2
double lambert_fraction(double squared) noexcept {
  // Cut off here, the tangent of pi / 4 is off by less than 2^-59 of itself.
  constexpr int kLastDenominator = 17;
  double fraction = kLastDenominator;
  for (int denominator = kLastDenominator - 2; denominator >= 3; denominator -= 2)
    fraction = denominator - squared / fraction;
  return fraction;
}

}  // namespace

double deterministic_tan(double angle) noexcept {
  // Both ways end with the addition of a smaller number, so the errors of the fraction count
  // little.
  if (angle <= kQuarterPi) {
    const double squared = angle * angle;
    return angle + angle * squared / (lambert_fraction(squared) - squared);
  }
  // tan(angle) = 1 / tan(pi / 2 - angle). The difference of the larger parts is exact; what the sum
  // with the smaller one loses changes the result by -1 / rest^2 of it.
  const double difference = kHalfPi - angle;
  const double rest = difference + kHalfPiRest;
  const double lost = (difference - rest) + kHalfPiRest;
  return 1.0 / rest - (rest / lambert_fraction(rest * rest) + lost / (rest * rest));
}

}  // namespace rangezip
