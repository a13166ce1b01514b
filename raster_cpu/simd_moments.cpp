// R13 by vectors of points, and of the four pixels of a point.
#include "raster_cpu/simd_kernels.h"

#include <algorithm>
#include <array>

#include "raster_cpu/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster_cpu/simd_moments.cpp"  // NOLINT
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "raster_cpu/moment_cell.h"
#include "raster_cpu/simd_bins-inl.h"
#include "raster_cpu/simd_snap-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rangezip::HWY_NAMESPACE {
#if RANGEZIP_HAS_VECTORS
namespace {

/// Coordinates relative to cells.
HWY_INLINE IntVec cell_number(IntVec v) {
  const Ints d;
  return hn::Add(hn::ShiftRight<kSubpixelBits>(hn::Sub(v, hn::Set(d, kHalfPixel))), hn::Set(d, 1));
}
HWY_INLINE IntVec cell_offset(IntVec v) {
  const Ints d;
  return hn::And(hn::Sub(v, hn::Set(d, kHalfPixel)), hn::Set(d, kSubpixels - 1));
}

template <bool kIsCentral>
std::size_t bin_cells(const RowTransform& rows, std::span<const Vec3f> positions,
                      std::span<const std::int8_t> votes, Extent extent, PointBins& bins) {
  const Ints d;
  return for_each_vector(positions, [&](const Vec3f* at, std::size_t number) {
    const Lanes p = load(at);
    const SnappedLanes s = snap_lanes<kIsCentral>(rows, p);
    const IntVec x = cell_number(s.x), y = cell_number(s.y);
    Mask summed = is_inside(rows, p, s.valid);
    summed =
        hn::And(summed, hn::And(is_below(x, extent.width + 1), is_below(y, extent.height + 1)));
    summed = hn::And(summed, is_in_depth_range(s.z));
    const IntVec row = hn::And(y, hn::Set(d, kCellRows - 1));
    const IntVec cell = hn::Or(hn::ShiftLeft<kCellRowBits>(x), row);
    const IntVec high = hn::Or(hn::ShiftLeft<kCellBits>(cell),
                               hn::Or(hn::ShiftLeft<8>(cell_offset(s.x)), cell_offset(s.y)));
    IntVec low = hn::ShiftLeft<8>(s.z);
    if (!votes.empty()) {
      std::array<std::int32_t, kLanes> lane_votes{};
      for (std::size_t lane = 0; lane < std::min(kLanes, votes.size() - number); ++lane)
        lane_votes[lane] = static_cast<std::uint8_t>(votes[number + lane]);
      low = hn::Or(low, hn::LoadU(d, lane_votes.data()));
    }
    append_lanes(bins, hn::ShiftRight<kCellRowBits>(y), high, low, summed);
    return kLanes - hn::CountTrue(d, s.valid);
  });
}

std::size_t bin_moments(const RowTransform& rows, std::span<const Vec3f> positions,
                        std::span<const std::int8_t> votes, Extent extent, PointBins& bins) {
  return rows.is_central ? bin_cells<true>(rows, positions, votes, extent, bins)
                         : bin_cells<false>(rows, positions, votes, extent, bins);
}

/// The four pixels around a cell, or as many as a vector has lanes: lower left, lower right, upper
/// left, upper right.
using Sums = hn::CappedTag<std::int64_t, 4>;
using SumVec = hn::Vec<Sums>;
constexpr std::size_t kSumLanes = hn::MaxLanes(Sums());
constexpr std::size_t kSumVectors = 4 / kSumLanes;
/// Each in the lower half of a 64-bit lane.
using Narrow = hn::Repartition<std::int32_t, Sums>;

HWY_INLINE SumVec product(SumVec a, SumVec b) {
  return hn::MulEven(hn::BitCast(Narrow(), a), hn::BitCast(Narrow(), b));
}

/// Sums of the points of one cell for its pixels, in registers.
class CellSums {
 public:
  /// @param lower_row, upper_row the pixels at the cell's lower left and upper left
  CellSums(const AccumulateWindow& window, std::size_t lower_row, std::size_t upper_row)
      : shift_(window.shift),
        lower_(load(window.band.lower, lower_row, upper_row)),
        upper_(load(window.band.upper, lower_row, upper_row)),
        reference_(load(window.reference, lower_row, upper_row)),
        count_(zero()),
        sums_{zero(), zero(), zero(), zero(), zero(), zero(), zero(), zero(), zero(), zero()} {}

  HWY_INLINE void add(BinEntry entry) {
    const Sums d;
    const Narrow dn;
    const SumVec z = hn::Set(d, depth_in_cell(entry));
    const SumVec vote = hn::Set(d, vote_of(entry));
    const SumVec offset_from_left = hn::Set(d, offset_x(entry));
    const SumVec offset_from_below = hn::Set(d, offset_y(entry));
    const SumVec whole = hn::Set(d, kSubpixels);
    for (std::size_t k = 0; k < kSumVectors; ++k) {
      const SumVec dx = hn::Sub(offset_from_left, to_right());
      const SumVec dy = hn::Sub(offset_from_below, to_above(k));
      const auto distance = [&](SumVec v) {
        return hn::BitCast(d, hn::Sub(hn::BitCast(dn, whole), hn::Abs(hn::BitCast(dn, v))));
      };
      const auto out = hn::Or(hn::Gt(lower_[k], z), hn::Gt(z, upper_[k]));
      const SumVec w = hn::IfThenZeroElse(out, product(distance(dx), distance(dy)));
      const SumVec from_reference =
          hn::BitCast(d, hn::ShiftRightSame(hn::BitCast(dn, hn::Sub(z, reference_[k])), shift_));
      const SumVec w_dx = product(w, dx), w_dy = product(w, dy);
      count_[k] = hn::Sub(count_[k], hn::VecFromMask(d, hn::Gt(w, hn::Zero(d))));
      const std::array<SumVec, 10> terms{w,
                                         w_dx,
                                         w_dy,
                                         product(w_dx, dx),
                                         product(w_dx, dy),
                                         product(w_dy, dy),
                                         product(w, from_reference),
                                         product(w_dx, from_reference),
                                         product(w_dy, from_reference),
                                         product(w, vote)};
      for (std::size_t i = 0; i < terms.size(); ++i)
        sums_[i][k] = hn::Add(sums_[i][k], terms[i]);
    }
  }

  /// Adds the sums to the pixels from `lower_row` and `upper_row` on.
  HWY_INLINE void store(const MomentTarget& target, std::size_t lower_row,
                        std::size_t upper_row) const {
    const std::array<std::size_t, 4> pixels{lower_row, lower_row + 1, upper_row, upper_row + 1};
    alignas(64) std::array<std::int64_t, 4> counts;
    for (std::size_t k = 0; k < kSumVectors; ++k)
      hn::Store(count_[k], Sums(), &counts[k * kSumLanes]);
    for (std::size_t i = 0; i < 4; ++i)
      count_points(target, pixels[i], static_cast<std::uint32_t>(counts[i]));
    for (std::size_t i = 0; i < sums_.size(); i += 2) {
      for (std::size_t k = 0; k < kSumVectors; ++k) {
        const auto left = hn::InterleaveLower(Sums(), sums_[i][k], sums_[i + 1][k]);
        const auto right = hn::InterleaveUpper(Sums(), sums_[i][k], sums_[i + 1][k]);
        add_pairs(target, left, i, pixels[2 * k], pixels[2]);
        add_pairs(target, right, i, pixels[2 * k + 1], pixels[3]);
      }
    }
  }

 private:
  using Pair = hn::CappedTag<std::int64_t, 2>;

  /// A value for each of the four pixels.
  using FourPixels = std::array<SumVec, kSumVectors>;

  static HWY_INLINE FourPixels zero() {
#if HWY_MAX_BYTES >= 32
    return {hn::Zero(Sums())};
#else
    return {hn::Zero(Sums()), hn::Zero(Sums())};
#endif
  }

  static HWY_INLINE FourPixels load(const Grid<std::int32_t>& grid, std::size_t lower_row,
                                    std::size_t upper_row) {
    const hn::CappedTag<std::int32_t, 2> two;
    const auto lower = hn::LoadU(two, grid.pixels().data() + lower_row);
    const auto upper = hn::LoadU(two, grid.pixels().data() + upper_row);
#if HWY_MAX_BYTES >= 32
    return {hn::PromoteTo(Sums(), hn::Combine(hn::CappedTag<std::int32_t, 4>(), upper, lower))};
#else
    return {hn::PromoteTo(Sums(), lower), hn::PromoteTo(Sums(), upper)};
#endif
  }

  static HWY_INLINE SumVec to_right() {
    alignas(32) static constexpr std::array<std::int64_t, 4> kRight{0, kSubpixels, 0, kSubpixels};
    return hn::Load(Sums(), kRight.data());
  }
  static HWY_INLINE SumVec to_above(std::size_t k) {
    alignas(32) static constexpr std::array<std::int64_t, 4> kAbove{0, 0, kSubpixels, kSubpixels};
    return hn::Load(Sums(), &kAbove[k * kSumLanes]);
  }

  /// Adds two sums, from number `first` on, to one pixel, or to two.
  static HWY_INLINE void add_pairs(const MomentTarget& target, SumVec pairs, std::size_t first,
                                   std::size_t pixel, [[maybe_unused]] std::size_t upper) {
#if HWY_MAX_BYTES >= 32
    add_pair(target, hn::LowerHalf(Pair(), pairs), first, pixel);
    add_pair(target, hn::UpperHalf(Pair(), pairs), first, upper);
#else
    add_pair(target, pairs, first, pixel);
#endif
  }
  static HWY_INLINE void add_pair(const MomentTarget& target, hn::Vec<Pair> pair, std::size_t first,
                                  std::size_t pixel) {
    static_assert(sizeof(PixelMoments) == 10 * sizeof(std::int64_t));
    std::int64_t* const at = &target.moments[pixel].w + first;
    hn::StoreU(hn::Add(hn::LoadU(Pair(), at), pair), Pair(), at);
  }

  int shift_;
  FourPixels lower_, upper_, reference_, count_;
  std::array<FourPixels, 10> sums_;
};

void add_moments(std::span<const BinEntry> entries, std::size_t bin, PixelRange rows,
                 const MomentTarget& target) {
  for (std::size_t begin = 0; begin < entries.size();) {
    std::size_t end = begin + 1;
    while (end < entries.size() && cell_of(entries[end]) == cell_of(entries[begin]))
      ++end;
    const auto run = entries.subspan(begin, end - begin);
    begin = end;
    const Pixel cell = cell_position(run.front(), bin);
    const bool has_four =
        cell.x > 0 && cell.x < target.extent.width && cell.y > rows.first && cell.y <= rows.last;
    if (!has_four) {
      for (const BinEntry entry : run)
        rangezip::add_moments(position_in_cell(entry, cell), vote_of(entry), rows, target);
      continue;
    }
    const std::size_t upper = target.extent.index({cell.x - 1, cell.y});
    const std::size_t lower = upper - static_cast<std::size_t>(target.extent.width);
    CellSums sums(*target.window, lower, upper);
    for (const BinEntry entry : run)
      sums.add(entry);
    sums.store(target, lower, upper);
  }
}

}  // namespace
#endif

void add_moment_kernels([[maybe_unused]] SimdKernels& kernels) {
#if RANGEZIP_HAS_VECTORS
  kernels.bin_moments = &bin_moments;
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
