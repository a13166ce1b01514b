// R2-R5, R9, R11 and R12 by vectors of points.
#include "raster_cpu/simd_kernels.h"

#include <algorithm>
#include <array>
#include <bit>

#include "raster_cpu/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster_cpu/simd_points.cpp"  // NOLINT
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "raster_cpu/simd_bins-inl.h"
#include "raster_cpu/simd_snap-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rangezip::HWY_NAMESPACE {
#if RANGEZIP_HAS_VECTORS
namespace {

template <bool kIsCentral>
KernelReport snap_all(const RowTransform& rows, std::span<const Vec3f> positions,
                      std::span<SnappedPosition> snapped) {
  const Ints d;
  KernelReport report;
  for (; report.processed + kLanes <= positions.size(); report.processed += kLanes) {
    prefetch_after(positions, report.processed);
    const Lanes p = load(&positions[report.processed]);
    SnappedLanes s = snap_lanes<kIsCentral>(rows, p);
    report.rejected += kLanes - hn::CountTrue(d, s.valid);
    const Mask kept = is_inside(rows, p, s.valid);
    s.x = hn::IfThenElse(kept, s.x, hn::Set(d, kRejected.x));
    s.y = hn::IfThenElseZero(kept, s.y);
    s.z = hn::IfThenElseZero(kept, s.z);
    hn::StoreInterleaved3(s.x, s.y, s.z, d, &snapped[report.processed].x);
  }
  return report;
}

/// Snaps a vector of points and lowers their pixels one by one, without a branch that depends on
/// the pixel. (Gathering the pixels' depths first, to lower only those that win, was slower but for
/// AVX-512 and points in random order.)
template <bool kIsCentral, bool kIsBanded>
KernelReport draw_all(const RowTransform& rows, std::span<const Vec3f> positions,
                      PrimitiveId first_id, const DrawTarget& target) {
  const Ints d;
  const IntVec width = hn::Set(d, target.extent.width);
  PixelKey* const keys = target.keys.data();
  struct {
    alignas(64) std::array<std::int32_t, kLanes> pixel, depth;
  } found;
  KernelReport report;
  for (; report.processed + kLanes <= positions.size(); report.processed += kLanes) {
    prefetch_after(positions, report.processed);
    const Lanes p = load(&positions[report.processed]);
    const SnappedLanes s = snap_lanes<kIsCentral>(rows, p);
    report.rejected += kLanes - hn::CountTrue(d, s.valid);
    const IntVec x = hn::ShiftRight<kSubpixelBits>(s.x), y = hn::ShiftRight<kSubpixelBits>(s.y);
    Mask drawn = is_inside(rows, p, s.valid);
    drawn = hn::And(drawn,
                    hn::And(is_below(x, target.extent.width), is_below(y, target.extent.height)));
    drawn = hn::And(drawn, is_in_depth_range(s.z));
    const IntVec pixel = hn::IfThenElseZero(drawn, hn::Add(hn::Mul(y, width), x));
    if constexpr (kIsBanded) {
      const IntVec lower = hn::GatherIndex(d, target.band->lower.pixels().data(), pixel);
      const IntVec upper = hn::GatherIndex(d, target.band->upper.pixels().data(), pixel);
      drawn = hn::AndNot(hn::Or(hn::Gt(lower, s.z), hn::Gt(s.z, upper)), drawn);
    }
    const auto base = first_id + static_cast<PrimitiveId>(report.processed);
    hn::Store(pixel, d, found.pixel.data());
    hn::Store(s.z, d, found.depth.data());
    for_each_bit(bits_of(drawn), [&](std::size_t lane) {
      PixelKey& key = keys[static_cast<std::size_t>(found.pixel[lane])];
      key = std::min(key, make_key(static_cast<std::uint32_t>(found.depth[lane]),
                                   base + static_cast<PrimitiveId>(lane)));
    });
  }
  return report;
}

KernelReport snap(const RowTransform& rows, std::span<const Vec3f> positions,
                  std::span<SnappedPosition> snapped) {
  return rows.is_central ? snap_all<true>(rows, positions, snapped)
                         : snap_all<false>(rows, positions, snapped);
}

KernelReport draw_single_pixels(const RowTransform& rows, std::span<const Vec3f> positions,
                                PrimitiveId first_id, const DrawTarget& target) {
  if (target.band == nullptr) {
    return rows.is_central ? draw_all<true, false>(rows, positions, first_id, target)
                           : draw_all<false, false>(rows, positions, first_id, target);
  }
  return rows.is_central ? draw_all<true, true>(rows, positions, first_id, target)
                         : draw_all<false, true>(rows, positions, first_id, target);
}

/// Sorts points into bins, a vector at a time.
template <bool kIsCentral, bool kIsSingle>
class PointBinner {
 public:
  PointBinner(const RowTransform& rows, int size, const BandLayout& layout, PointBins& bins)
      : rows_(rows), layout_(layout), bins_(bins), size_(kIsSingle ? 1 : size) {}

  /// Points `number` and up of the run. @return number of lanes rejected by R3 or R4
  HWY_INLINE std::size_t operator()(const Vec3f* positions, std::size_t number) const {
    const Ints d;
    const Lanes p = load(positions);
    const SnappedLanes s = snap_lanes<kIsCentral>(rows_, p);
    const IntVec to_corner = hn::Set(d, kHalfPixel * (size_ - 1));
    const IntVec x = hn::ShiftRight<kSubpixelBits>(hn::Sub(s.x, to_corner));
    const IntVec y = hn::ShiftRight<kSubpixelBits>(hn::Sub(s.y, to_corner));
    Mask drawn = is_inside(rows_, p, s.valid);
    const int hanging = kIsSingle ? 0 : size_ - 1;  // pixels that may lie outside of the image
    const auto touches = [&](IntVec first, int size) {
      return is_below(hn::Add(first, hn::Set(d, hanging)), size + hanging);
    };
    drawn = hn::And(drawn,
                    hn::And(touches(x, layout_.extent.width), touches(y, layout_.extent.height)));
    drawn = hn::And(drawn, is_in_depth_range(s.z));
    const IntVec lower = band_of(kIsSingle ? y : hn::Max(y, hn::Zero(d)));
    append(lower, x, y, s.z, number, drawn);
    if constexpr (!kIsSingle) {
      const IntVec top =
          hn::Min(hn::Add(y, hn::Set(d, size_ - 1)), hn::Set(d, layout_.extent.height - 1));
      const IntVec upper = band_of(top);
      append(upper, x, y, s.z, number, hn::And(drawn, hn::Ne(lower, upper)));
    }
    return kLanes - hn::CountTrue(d, s.valid);
  }

 private:
  [[nodiscard]] HWY_INLINE IntVec band_of(IntVec y) const {
    return hn::ShiftRightSame(y, layout_.rows_log2);
  }

  HWY_INLINE void append(IntVec band, IntVec x, IntVec y, IntVec z, std::size_t number,
                         Mask which) const {
    const Ints d;
    const IntVec margin = hn::Set(d, layout_.margin);
    const IntVec row = hn::Add(hn::Sub(y, hn::ShiftLeftSame(band, layout_.rows_log2)), margin);
    const IntVec pixel = hn::Add(hn::Mul(row, hn::Set(d, layout_.stride())), hn::Add(x, margin));
    const IntVec id = hn::Add(hn::Set(d, static_cast<std::int32_t>(number)), lane_numbers_);
    // The two halves of a Fragment.
    constexpr int kDepthInLow = 32 - kRunBits;
    const auto low = hn::Or(hn::ShiftLeft<kRunBits>(z), id);
    const auto high =
        hn::Or(hn::ShiftLeft<kDepthBits - kDepthInLow>(pixel), hn::ShiftRight<kDepthInLow>(z));
    append_lanes(bins_, band, high, low, which);
  }

  const RowTransform& rows_;
  const BandLayout& layout_;
  PointBins& bins_;
  int size_;
  IntVec lane_numbers_ = hn::Iota(Ints(), 0);
};

template <bool kIsCentral, bool kIsSingle>
std::size_t bin_all_points(const RowTransform& rows, std::span<const Vec3f> positions, int size,
                           const BandLayout& layout, PointBins& bins) {
  return for_each_vector(positions, PointBinner<kIsCentral, kIsSingle>(rows, size, layout, bins));
}

std::size_t bin_points(const RowTransform& rows, std::span<const Vec3f> positions, int size,
                       const BandLayout& layout, PointBins& bins) {
  if (size == 1) {
    return rows.is_central ? bin_all_points<true, true>(rows, positions, 1, layout, bins)
                           : bin_all_points<false, true>(rows, positions, 1, layout, bins);
  }
  return rows.is_central ? bin_all_points<true, false>(rows, positions, size, layout, bins)
                         : bin_all_points<false, false>(rows, positions, size, layout, bins);
}

/// The key that a fragment gives its pixels.
PixelKey key_of(Fragment fragment, PrimitiveId first_id) {
  return make_key(depth_of(fragment), first_id + number_in_run(fragment));
}

constexpr std::size_t kLineFragments = 64 / sizeof(Fragment);

void fetch(std::span<const Fragment> fragments) {
  for (std::size_t i = 0; i < fragments.size(); i += kLineFragments)
    hwy::Prefetch(&fragments[i]);
}

/// Calls visit(fragment) for every fragment of a run, and fetches the run `next` meanwhile: a line
/// for a line, since where a run begins the hardware cannot know.
template <class Visit>
HWY_INLINE void for_each_fragment(std::span<const Fragment> run, std::span<const Fragment> next,
                                  const Visit& visit) {
  std::size_t i = 0;
  for (; i + kLineFragments <= run.size(); i += kLineFragments) {
    if (i < next.size()) hwy::Prefetch(&next[i]);
    for (std::size_t k = i; k < i + kLineFragments; ++k)
      visit(run[k]);
  }
  for (; i < run.size(); ++i)
    visit(run[i]);
}

void lower_pixels(const PointBins::Run& run, std::span<const Fragment> next, PixelKey* keys) {
  for_each_fragment(run.entries, next, [&](Fragment fragment) {
    PixelKey& key = keys[tile_pixel(fragment)];
    key = std::min(key, key_of(fragment, run.first_id));
  });
}

/// Lowers kCount pixels of a row: by the largest vectors that fit, then by smaller ones.
template <std::size_t kCount>
HWY_INLINE void lower_row(PixelKey* row, PixelKey wanted) {
  if constexpr (kCount > 0) {
    const hn::CappedTag<PixelKey, std::bit_floor(kCount)> d;
    constexpr std::size_t kKeys = hn::MaxLanes(d);
    hn::StoreU(hn::Min(hn::LoadU(d, row), hn::Set(d, wanted)), d, row);
    lower_row<kCount - kKeys>(row + kKeys, wanted);
  }
}

template <std::size_t kSize>
void lower_squares(const PointBins::Run& run, std::span<const Fragment> next, PixelKey* keys,
                   std::size_t stride) {
  for_each_fragment(run.entries, next, [&](Fragment fragment) {
    const PixelKey wanted = key_of(fragment, run.first_id);
    PixelKey* row = keys + tile_pixel(fragment);
    for (std::size_t y = 0; y < kSize; ++y, row += stride)
      lower_row<kSize>(row, wanted);
  });
}

/// R12: a pixel counts where the depth lies in its interval.
void lower_in_band(const PointBins::Run& run, std::span<const Fragment> next, PixelKey* keys,
                   std::size_t stride, const Tile::Depths& depths) {
  const auto size = static_cast<std::size_t>(run.point_size);
  for_each_fragment(run.entries, next, [&](Fragment fragment) {
    const PixelKey wanted = key_of(fragment, run.first_id);
    const auto depth = static_cast<std::int32_t>(depth_of(fragment));
    std::size_t row = tile_pixel(fragment);
    for (std::size_t y = 0; y < size; ++y, row += stride) {
      for (std::size_t pixel = row; pixel < row + size; ++pixel) {
        const bool counts = depths.lower[pixel] <= depth && depth <= depths.upper[pixel];
        keys[pixel] = std::min(keys[pixel], counts ? wanted : kEmptyPixel);
      }
    }
  });
}

void draw_run(const PointBins::Run& run, std::span<const Fragment> next, Tile& tile) {
  PixelKey* const keys = tile.keys();
  const Tile::Depths depths = tile.depths();
  if (depths.lower != nullptr) return lower_in_band(run, next, keys, tile.stride(), depths);
  static_assert(kMaxBinnedSize == 5);
  switch (run.point_size) {
    case 1:
      return lower_pixels(run, next, keys);
    case 2:
      return lower_squares<2>(run, next, keys, tile.stride());
    case 3:
      return lower_squares<3>(run, next, keys, tile.stride());
    case 4:
      return lower_squares<4>(run, next, keys, tile.stride());
    default:
      return lower_squares<5>(run, next, keys, tile.stride());
  }
}

void draw_fragments(std::span<const PointBins::Run> runs, Tile& tile) {
  if (!runs.empty()) fetch(runs.front().entries);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const bool is_last = i + 1 == runs.size();
    draw_run(runs[i], is_last ? std::span<const Fragment>() : runs[i + 1].entries, tile);
  }
}

void unpack_past_cache(std::span<const PixelKey> keys, std::uint32_t* depth, PrimitiveId* id) {
  const hn::CappedTag<std::uint32_t, 4> d;
  const hn::CappedTag<PixelKey, 2> dk;
  constexpr std::size_t kKeys = hn::MaxLanes(d);
  const auto is_aligned = [](const std::uint32_t* at) {
    return reinterpret_cast<std::uintptr_t>(at) % (kKeys * sizeof(*at)) == 0;
  };
  std::size_t i = 0;
  while (i < keys.size() && !is_aligned(depth + i)) {
    unpack_key(keys[i], depth[i], id[i]);
    ++i;
  }
  for (; i + kKeys <= keys.size() && is_aligned(id + i); i += kKeys) {
    const auto first = hn::BitCast(d, hn::LoadU(dk, &keys[i]));
    const auto second = hn::BitCast(d, hn::LoadU(dk, &keys[i + 2]));
    hn::Stream(hn::ConcatOdd(d, second, first), d, depth + i);
    hn::Stream(hn::ConcatEven(d, second, first), d, id + i);
  }
  for (; i < keys.size(); ++i)
    unpack_key(keys[i], depth[i], id[i]);
  hwy::FlushStream();
}

}  // namespace
#endif

void add_point_kernels([[maybe_unused]] SimdKernels& kernels) {
#if RANGEZIP_HAS_VECTORS
  kernels.snap = &snap;
  kernels.draw_single_pixels = &draw_single_pixels;
  kernels.bin_points = &bin_points;
  kernels.draw_fragments = &draw_fragments;
  kernels.unpack_past_cache = &unpack_past_cache;
#endif
}

}  // namespace rangezip::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace rangezip {

HWY_EXPORT(add_point_kernels);

void add_point_kernels(std::size_t target, SimdKernels& kernels) {
  const auto add = HWY_DISPATCH_TABLE(add_point_kernels)[target];
  if (add != nullptr) add(kernels);
}

}  // namespace rangezip

#endif  // HWY_ONCE
