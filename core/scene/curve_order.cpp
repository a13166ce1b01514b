#include "core/scene/curve_order.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace rangezip {

namespace {

constexpr int kCellBits = 10;  ///< per axis; a digit of the radix sort, too
constexpr std::uint32_t kCells = 1U << kCellBits;

struct FloatBox {
  Vec3f lower{0.0F};
  Vec3f upper{0.0F};
};

FloatBox bounds_of(std::span<const Vec3f> positions) {
  if (positions.empty()) return {};
  FloatBox box{positions.front(), positions.front()};
  for (const Vec3f& p : positions) {
    box.lower = glm::min(box.lower, p);
    box.upper = glm::max(box.upper, p);
  }
  return box;
}

/// In double: a box may be too large for the difference of two floats.
double diagonal(const FloatBox& box) {
  return glm::length(Vec3(box.upper) - Vec3(box.lower));
}

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

std::vector<Entry> entries_of(std::span<const Vec3f> positions) {
  const FloatBox box = bounds_of(positions);
  const Vec3 size = Vec3(box.upper) - Vec3(box.lower);
  const double longest = std::max({size.x, size.y, size.z});
  const double cells_per_unit = longest > 0.0 ? kCells / longest : 0.0;
  const auto cell = [&](double offset) {
    return std::min(static_cast<std::uint32_t>(offset * cells_per_unit), kCells - 1);
  };
  std::vector<Entry> entries;
  entries.reserve(positions.size());
  for (const Vec3f& p : positions) {
    const Vec3 offset = Vec3(p) - Vec3(box.lower);
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

}  // namespace

bool follow_each_other(std::span<const Vec3f> positions) {
  constexpr std::size_t kPairs = 1024;
  if (positions.size() < 2) return true;
  const double near = diagonal(bounds_of(positions)) / 64.0;
  std::size_t close = 0;
  for (std::size_t pair = 0; pair < kPairs; ++pair) {
    const std::size_t at = (positions.size() - 2) * pair / (kPairs - 1);
    close += glm::length(Vec3(positions[at + 1]) - Vec3(positions[at])) <= near ? 1 : 0;
  }
  return close > kPairs / 2;
}

PointCloud ordered_along_curve(const PointCloud& cloud) {
  std::vector<Entry> entries = entries_of(cloud.positions);
  std::vector<Entry> sorted(entries.size());
  constexpr int kDigits = 3;
  for (int digit = 0; digit < kDigits; ++digit) {
    sort_by_digit(entries, sorted, digit);
    entries.swap(sorted);
  }
  PointCloud ordered;
  ordered.positions.reserve(entries.size());
  ordered.numbers.reserve(entries.size());
  for (const Entry& e : entries) {
    ordered.positions.push_back(cloud.positions[e.index]);
    ordered.numbers.push_back(cloud.numbers.empty() ? e.index : cloud.numbers[e.index]);
  }
  return ordered;
}

}  // namespace rangezip
