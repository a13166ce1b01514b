// Putting a vector of points into bins, for each set of instructions: included by the files that
// Highway compiles once for each (#include <foreach_target.h>).

#if defined(RANGEZIP_SIMD_BINS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RANGEZIP_SIMD_BINS_INL_H
#undef RANGEZIP_SIMD_BINS_INL_H
#else
#define RANGEZIP_SIMD_BINS_INL_H
#endif

#include <array>
#include <cstring>
#include <limits>

#include "core/base/geometry.h"
#include "raster_cpu/point_bins.h"
#include "raster_cpu/simd_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rangezip::HWY_NAMESPACE {
#if RANGEZIP_HAS_VECTORS
namespace {

/// Appends the entries (high << 32 | low) of the lanes in `which` to the bins `bin`.
HWY_INLINE void append_lanes(PointBins& bins, IntVec bin, IntVec high, IntVec low, Mask which) {
  const Ints d;
  // With many bins the hardware does not fetch what is written next.
  constexpr std::ptrdiff_t kAhead = 16;
  alignas(64) std::array<std::int32_t, 2 * kLanes> entries;
  alignas(64) std::array<std::int32_t, kLanes> numbers;
  hn::StoreInterleaved2(low, high, d, entries.data());
  hn::Store(bin, d, numbers.data());
  BinEntry** const cursors = bins.cursors();
  for_each_bit(bits_of(which), [&](std::size_t lane) {
    const auto number = static_cast<std::uint32_t>(numbers[lane]);
    BinEntry* cursor = cursors[number];
    // Copied by itself: compilers copy all entries of a vector through general registers.
    std::memcpy(cursor++, &entries[2 * lane], sizeof(BinEntry));
    hwy::Prefetch(cursor + kAhead);
    cursors[number] = PointBins::is_block_full(cursor) ? bins.grow(number, cursor) : cursor;
  });
}

/// Calls add(first position, number of the first) for every vector of positions; the last one is
/// filled up with points that R3 and R4 reject.
/// @param add returns the number of lanes that R3 or R4 reject
/// @return number of positions that they reject
template <class Add>
HWY_INLINE std::size_t for_each_vector(std::span<const Vec3f> positions, const Add& add) {
  std::size_t rejected = 0;
  std::size_t i = 0;
  for (; i + kLanes <= positions.size(); i += kLanes) {
    prefetch_after(positions, i);
    rejected += add(&positions[i], i);
  }
  if (i == positions.size()) return rejected;
  std::array<Vec3f, kLanes> last;
  last.fill(Vec3f{std::numeric_limits<float>::quiet_NaN()});
  std::copy(positions.begin() + static_cast<std::ptrdiff_t>(i), positions.end(), last.begin());
  return rejected + add(last.data(), i) - (kLanes - (positions.size() - i));
}

}  // namespace
#endif
}  // namespace rangezip::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // RANGEZIP_SIMD_BINS_INL_H
