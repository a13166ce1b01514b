#pragma once

#include <cstdint>

namespace rangezip::compare {

/// A number in [0, 1) by the generator splitmix64 [Steele, Lea, Flood 2014]: a hash of (seed, i),
/// the same everywhere.
[[nodiscard]] inline double uniform_in_unit_interval(std::uint64_t seed, std::uint64_t i) {
  std::uint64_t z = seed + (i + 1) * 0x9e3779b97f4a7c15U;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  z ^= z >> 31U;
  constexpr double kUnit = 0x1.0p-53;  // of the 53 bits that a double holds
  return static_cast<double>(z >> 11U) * kUnit;
}

}  // namespace rangezip::compare
