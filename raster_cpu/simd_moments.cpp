// R13 by vectors of 64-bit lanes.
#include "raster_cpu/simd_kernels.h"

#include <array>
#include <cstdlib>

// Vectors whose length is known only at run time can be no members; ARM has NEON beside them.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster_cpu/simd_moments.cpp"  // NOLINT
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "raster_cpu/simd_snap-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rangezip::HWY_NAMESPACE {
#if HWY_TARGET != HWY_SCALAR
namespace {

#if HWY_MAX_BYTES >= 32
using Sums = hn::CappedTag<std::int64_t, 8>;
using SumVec = hn::Vec<Sums>;

/// Which of the factors 1, dx, dy and z a lane takes: sums 0 to 7 of PixelMoments are w times the
/// product of two of them. The last two, w z dy and w vote, are left to scalar code.
constexpr std::array<std::int64_t, 8> kFirstFactor{0, 1, 2, 1, 1, 2, 3, 3};
constexpr std::array<std::int64_t, 8> kSecondFactor{0, 0, 0, 1, 2, 2, 0, 1};

/// The lanes that begin at sum `first`.
class SumLanes {
 public:
  explicit SumLanes(std::size_t first)
      : which_first_(hn::LoadU(d_, &kFirstFactor[first])),
        which_second_(hn::LoadU(d_, &kSecondFactor[first])) {}

  /// Adds w times the products to the sums. All factors are below 2^31, so the even halves of the
  /// lanes hold them.
  void add(std::int64_t* sums, SumVec dx, SumVec dy, SumVec z, SumVec w) const {
    const hn::Repartition<std::int32_t, Sums> d32;
    const auto first = hn::BitCast(d32, choose(which_first_, dx, dy, z));
    const auto second = hn::BitCast(d32, choose(which_second_, dx, dy, z));
    const auto product =
        hn::MulEven(hn::BitCast(d32, hn::MulEven(first, second)), hn::BitCast(d32, w));
    hn::StoreU(hn::Add(hn::LoadU(d_, sums), product), d_, sums);
  }

 private:
  [[nodiscard]] SumVec choose(SumVec which, SumVec dx, SumVec dy, SumVec z) const {
    SumVec factor = hn::Set(d_, 1);
    factor = hn::IfThenElse(hn::Eq(which, hn::Set(d_, 1)), dx, factor);
    factor = hn::IfThenElse(hn::Eq(which, hn::Set(d_, 2)), dy, factor);
    return hn::IfThenElse(hn::Eq(which, hn::Set(d_, 3)), z, factor);
  }

  Sums d_;
  SumVec which_first_;
  SumVec which_second_;
};

HWY_INLINE void add_terms(PixelMoments& sums,
                          const std::array<SumLanes, 8 / hn::MaxLanes(Sums())>& lanes,
                          std::int32_t dx, std::int32_t dy, std::int64_t z, int vote) {
  const Sums d;
  const std::int64_t w = std::int64_t{kSubpixels - std::abs(dx)} * (kSubpixels - std::abs(dy));
  const SumVec dxs = hn::Set(d, dx), dys = hn::Set(d, dy), zs = hn::Set(d, z), ws = hn::Set(d, w);
  std::int64_t* at = &sums.w;
  for (const SumLanes& part : lanes) {
    part.add(at, dxs, dys, zs, ws);
    at += hn::MaxLanes(d);
  }
  sums.w_z_dy += w * z * dy;
  sums.w_vote += w * vote;
}

void add_moments(std::span<const RowBins::Point> points, PixelRange rows,
                 const MomentTarget& target) {
  static_assert(sizeof(PixelMoments) == 10 * sizeof(std::int64_t));
  const auto lanes = [] {
    if constexpr (hn::MaxLanes(Sums()) == 8) {
      return std::array{SumLanes(0)};
    } else {
      return std::array{SumLanes(0), SumLanes(4)};
    }
  }();
  for_each_term(points, rows, target,
                [&](PixelMoments& sums, std::int32_t dx, std::int32_t dy, std::int64_t z,
                    int vote) { add_terms(sums, lanes, dx, dy, z, vote); });
}
#endif

}  // namespace
#endif

void add_moment_kernels([[maybe_unused]] SimdKernels& kernels) {
#if HWY_TARGET != HWY_SCALAR && HWY_MAX_BYTES >= 32
  kernels.add_moments = &add_moments;
#endif
}

}  // namespace rangezip::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace rangezip {

HWY_EXPORT(add_moment_kernels);

void add_moment_kernels(std::size_t target, SimdKernels& kernels) {
  const auto add = HWY_DISPATCH_TABLE(add_moment_kernels)[target];
  if (add != nullptr) add(kernels);
}

}  // namespace rangezip

#endif  // HWY_ONCE
