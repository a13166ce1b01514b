#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace rangezip {

/// The T stored at `at`, its bytes in the machine's own order or, `is_swapped`, the other way
/// round.
template <class T>
[[nodiscard]] T load_bytes(const char* at, bool is_swapped) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), at, sizeof(T));
  if (is_swapped) std::reverse(bytes.begin(), bytes.end());
  return std::bit_cast<T>(bytes);
}

inline constexpr bool kIsLittleEndian = std::endian::native == std::endian::little;

/// The T stored at `at`, lowest byte first.
template <class T>
[[nodiscard]] T load_little(const char* at) {
  return load_bytes<T>(at, !kIsLittleEndian);
}

/// The bytes of `value`, lowest first.
template <class T>
[[nodiscard]] std::array<char, sizeof(T)> little_bytes(T value) {
  auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if constexpr (!kIsLittleEndian) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

}  // namespace rangezip
