#pragma once

#include <cstdint>

#include "core/base/spread.h"

namespace rangezip::compare {

/// A number in [0, 1) by the generator splitmix64 [Steele, Lea, Flood 2014]: a hash of (seed, i),
/// the same everywhere.
[[nodiscard]] inline double uniform_in_unit_interval(std::uint64_t seed, std::uint64_t i) {
  const std::uint64_t bits = scrambled_bits(seed + i * 0x9e37'79b9'7f4a'7c15U);
  constexpr double kUnit = 0x1.0p-53;  // of the 53 bits that a double holds
  return static_cast<double>(bits >> 11U) * kUnit;
}

}  // namespace rangezip::compare
