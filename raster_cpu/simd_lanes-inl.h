// What kernels over vectors of points or triangles share, for each set of instructions: included by
// the files that Highway compiles once for each (#include <foreach_target.h>).

#if defined(RANGEZIP_SIMD_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RANGEZIP_SIMD_LANES_INL_H
#undef RANGEZIP_SIMD_LANES_INL_H
#else
#define RANGEZIP_SIMD_LANES_INL_H
#endif

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

HWY_BEFORE_NAMESPACE();
namespace rangezip::HWY_NAMESPACE {
#if RANGEZIP_HAS_VECTORS
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// At most 256 bits: what a wider store leaves for scalar loads arrives late (AMD Zen 4: points in
/// random order at two thirds of the rate).
using Floats = hn::CappedTag<float, 8>;
using Ints = hn::RebindToSigned<Floats>;
using FloatVec = hn::Vec<Floats>;
using IntVec = hn::Vec<Ints>;
using Mask = hn::Mask<Ints>;

constexpr std::size_t kLanes = hn::MaxLanes(Floats());

/// 0 <= v < end.
HWY_INLINE Mask is_below(IntVec v, std::int32_t end) {
  const hn::RebindToUnsigned<Ints> d;  // where negative numbers are large
  return hn::RebindMask(Ints(),
                        hn::Lt(hn::BitCast(d, v), hn::Set(d, static_cast<std::uint32_t>(end))));
}

/// Fetches what comes some vectors after items[at], kLanes of which are read at once: the hardware
/// alone is late (by a fifth of the rate, in virtual machines above all).
template <class Item>
HWY_INLINE void prefetch_after(std::span<const Item> items, std::size_t at) {
  static_assert(sizeof(Item) == 12);
  constexpr std::size_t kAhead = 256;
  constexpr std::size_t kLine = 64 / sizeof(Item);
  const std::size_t last = items.size() - 1;
  hwy::Prefetch(&items[std::min(at + kAhead, last)]);
  if constexpr (kLanes > kLine) hwy::Prefetch(&items[std::min(at + kAhead + kLine, last)]);
}

/// One bit a lane. Highway writes bytes: the one that counts is read alone, since a wider read
/// would wait for it.
HWY_INLINE unsigned bits_of(Mask mask) {
  static_assert(kLanes <= 8);
  std::array<std::uint8_t, 8> bytes;
  hn::StoreMaskBits(Ints(), mask, bytes.data());
  return bytes[0];
}

/// Calls visit(lane) for every set bit, the lowest first. All set is the usual case.
template <class Visit>
HWY_INLINE void for_each_bit(unsigned bits, const Visit& visit) {
  if (bits == (1U << kLanes) - 1) {
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      visit(lane);
    return;
  }
  for (; bits != 0; bits &= bits - 1)
    visit(static_cast<std::size_t>(std::countr_zero(bits)));
}

}  // namespace
#endif
}  // namespace rangezip::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // RANGEZIP_SIMD_LANES_INL_H
