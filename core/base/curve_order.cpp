#include "core/base/curve_order.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace rangezip {

namespace {

constexpr int kCellBits = 10;  ///< per axis; a digit of the radix sort, too
constexpr std::uint32_t kCells = 1U << kCellBits;

/// Moves bit i to bit 3 i, for ten bits.
std::uint32_t spread_bits(std::uint32_t v) {
  v = (v | v << 16U) & 0x0300'00ffU;
  v = (v | v << 8U) & 0x0300'f00fU;
  v = (v | v << 4U) & 0x030c'30c3U;
  return (v | v << 2U) & 0x0924'9249U;
}

/// A point's place along the curve, 30 bits, and its place in the order given.
struct Entry {
  std::uint32_t code = 0;
  std::uint32_t index = 0;
};

template <class Place>
std::vector<Entry> entries_of(std::span<const Place> places) {
  Box box;
  for (const Place& p : places)
    box.add(Vec3(p));
  const Vec3 size = box.upper - box.lower;
  const double longest = std::max({size.x, size.y, size.z});
  const double cells_per_unit = longest > 0.0 ? kCells / longest : 0.0;
  const auto cell = [&](double offset) {
    return std::min(static_cast<std::uint32_t>(offset * cells_per_unit), kCells - 1);
  };
  std::vector<Entry> entries;
  entries.reserve(places.size());
  for (const Place& p : places) {
    const Vec3 offset = Vec3(p) - box.lower;
    const std::uint32_t code = spread_bits(cell(offset.x)) | spread_bits(cell(offset.y)) << 1U |
                               spread_bits(cell(offset.z)) << 2U;
    entries.push_back({code, static_cast<std::uint32_t>(entries.size())});
  }
  return entries;
}

/// Sorts by one digit of the codes, keeping the order of equal ones.
void sort_by_digit(std::span<const Entry> from, std::span<Entry> to, int digit) {
  const auto digit_of = [&](const Entry& e) {
    return e.code >> (digit * kCellBits) & (kCells - 1);
  };
  std::array<std::uint32_t, kCells + 1> starts{};
  for (const Entry& e : from)
    ++starts[digit_of(e) + 1];
  for (std::size_t d = 0; d < kCells; ++d)
    starts[d + 1] += starts[d];
  for (const Entry& e : from)
    to[starts[digit_of(e)]++] = e;
}

template <class Place>
std::vector<std::uint32_t> order_of(std::span<const Place> places, const Progress& progress) {
  std::vector<Entry> entries = entries_of(places);
  std::vector<Entry> sorted(entries.size());
  constexpr int kDigits = 3;
  for (int digit = 0; digit < kDigits; ++digit) {
    progress.check_stop();
    sort_by_digit(entries, sorted, digit);
    entries.swap(sorted);
  }
  std::vector<std::uint32_t> order(entries.size());
  std::transform(entries.begin(), entries.end(), order.begin(),
                 [](const Entry& e) { return e.index; });
  return order;
}

}  // namespace

std::vector<std::uint32_t> order_along_curve(std::span<const Vec3f> places,
                                             const Progress& progress) {
  return order_of(places, progress);
}

std::vector<std::uint32_t> order_along_curve(std::span<const Vec3> places) {
  return order_of(places, {});
}

}  // namespace rangezip
