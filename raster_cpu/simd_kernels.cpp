#include "raster_cpu/simd_kernels.h"

#include <array>
#include <bit>
#include <cstring>

// Vectors whose length is known only at run time can be no members; ARM has NEON beside them.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)

// Highway compiles this file once for each set of instructions (#include <foreach_target.h>).
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster_cpu/simd_kernels.cpp"  // NOLINT
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "raster_cpu/fixed_point.h"

HWY_BEFORE_NAMESPACE();
namespace rangezip::HWY_NAMESPACE {
#if HWY_TARGET != HWY_SCALAR  // its vectors have one lane: the scalar code is better
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

/// Positions of a vector of points, one coordinate a vector.
struct Lanes {
  FloatVec x, y, z;
};

/// Snapped coordinates; where `valid` is false they mean nothing.
struct SnappedLanes {
  IntVec x, y, z;
  Mask valid;
};

HWY_INLINE Lanes load(const Vec3f* positions) {
  const Floats d;
  Lanes p;
  hn::LoadInterleaved3(d, &positions->x, p.x, p.y, p.z);
  return p;
}

/// R2. Never fused: the build forbids contraction.
HWY_INLINE FloatVec row_product(const Row& row, const Lanes& p) {
  const Floats d;
  FloatVec sum = hn::Mul(hn::Set(d, row[0]), p.x);
  sum = hn::Add(sum, hn::Mul(hn::Set(d, row[1]), p.y));
  sum = hn::Add(sum, hn::Mul(hn::Set(d, row[2]), p.z));
  return hn::Add(sum, hn::Set(d, row[3]));
}

/// |v| <= limit, false for NaN.
HWY_INLINE hn::Mask<Floats> is_within(FloatVec v, FloatVec limit) {
  return hn::Le(hn::Abs(v), limit);
}

/// R3.
HWY_INLINE SnappedLanes snap_parallel(const RowTransform& rows, const Lanes& p) {
  const Floats d;
  const FloatVec x = row_product(rows.x, p), y = row_product(rows.y, p), z = row_product(rows.z, p);
  const FloatVec max_xy = hn::Set(d, static_cast<float>(kGuardXY));
  const FloatVec max_z = hn::Set(d, static_cast<float>(kGuardZ));
  const auto valid =
      hn::And(hn::And(is_within(x, max_xy), is_within(y, max_xy)), is_within(z, max_z));
  // NearestInt rounds ties to even in the default rounding mode.
  return {hn::NearestInt(x), hn::NearestInt(y), hn::NearestInt(z), hn::RebindMask(Ints(), valid)};
}

/// R4 for half a vector, in double: the exact nearest integer to v / w.
template <class Half>
HWY_INLINE hn::Vec<hn::Rebind<std::int32_t, Half>> round_quotient(Half half, hn::Vec<Half> v,
                                                                  hn::Vec<Half> w,
                                                                  hn::Vec<Half> per_w) {
  const auto one = hn::Set(half, 1.0);
  auto q = hn::Round(hn::Mul(v, per_w));  // within 1 of the exact quotient
  const auto v2 = hn::Add(v, v);
  const auto q2 = hn::Add(q, q);
  // Both products have at most 27 + 24 bits: exact.
  const auto is_high = hn::Lt(v2, hn::Mul(hn::Sub(q2, one), w));
  const auto is_low = hn::Ge(v2, hn::Mul(hn::Add(q2, one), w));
  q = hn::IfThenElse(is_high, hn::Sub(q, one), q);
  q = hn::IfThenElse(is_low, hn::Add(q, one), q);
  return hn::DemoteTo(hn::Rebind<std::int32_t, Half>(), q);
}

/// R4.
HWY_INLINE SnappedLanes snap_central(const RowTransform& rows, const Lanes& p) {
  const Floats d;
  const FloatVec x = row_product(rows.x, p), y = row_product(rows.y, p), z = row_product(rows.z, p),
                 w = row_product(rows.w, p);
  // Powers of two times w: exact, as in double.
  const FloatVec max_xy = hn::Mul(w, hn::Set(d, static_cast<float>(kGuardXY)));
  const FloatVec max_z = hn::Mul(w, hn::Set(d, static_cast<float>(kGuardZ)));
  auto valid = hn::And(hn::Ge(w, hn::Set(d, 0x1p-64F)), hn::Le(w, hn::Set(d, 0x1p64F)));
  valid = hn::And(valid, hn::And(is_within(x, max_xy), is_within(y, max_xy)));
  valid = hn::And(valid, is_within(z, max_z));

  const hn::Repartition<double, Floats> half;
  const hn::Half<Floats> d_half;
  const auto quotients = [&](FloatVec v, auto w_low, auto w_high, auto per_low, auto per_high) {
    const auto low =
        round_quotient(half, hn::PromoteTo(half, hn::LowerHalf(d_half, v)), w_low, per_low);
    const auto high =
        round_quotient(half, hn::PromoteTo(half, hn::UpperHalf(d_half, v)), w_high, per_high);
    return hn::Combine(Ints(), high, low);
  };
  const auto w_low = hn::PromoteTo(half, hn::LowerHalf(d_half, w));
  const auto w_high = hn::PromoteTo(half, hn::UpperHalf(d_half, w));
  const auto one = hn::Set(half, 1.0);
  const auto per_low = hn::Div(one, w_low), per_high = hn::Div(one, w_high);
  return {quotients(x, w_low, w_high, per_low, per_high),
          quotients(y, w_low, w_high, per_low, per_high),
          quotients(z, w_low, w_high, per_low, per_high), hn::RebindMask(Ints(), valid)};
}

/// R11.
HWY_INLINE Mask is_inside(const RowTransform& rows, const Lanes& p, Mask mask) {
  const Floats d;
  for (const Row& plane : rows.clip) {
    const auto inside = hn::Ge(row_product(plane, p), hn::Zero(d));
    mask = hn::And(mask, hn::RebindMask(Ints(), inside));
  }
  return mask;
}

template <bool kIsCentral>
HWY_INLINE SnappedLanes snap_lanes(const RowTransform& rows, const Lanes& p) {
  if constexpr (kIsCentral) {
    return snap_central(rows, p);
  } else {
    return snap_parallel(rows, p);
  }
}

template <bool kIsCentral>
KernelReport snap_all(const RowTransform& rows, std::span<const Vec3f> positions,
                      std::span<SnappedPosition> snapped) {
  const Ints d;
  KernelReport report;
  for (; report.processed + kLanes <= positions.size(); report.processed += kLanes) {
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

/// One bit a lane.
HWY_INLINE std::uint64_t bits_of(Mask mask) {
  std::array<std::uint8_t, 8> bytes{};
  hn::StoreMaskBits(Ints(), mask, bytes.data());
  std::uint64_t bits = 0;
  std::memcpy(&bits, bytes.data(), sizeof(bits));
  return std::endian::native == std::endian::little ? bits : bits >> 56U;
}

/// Calls visit(lane) for every set bit, the lowest first. All set is the usual case.
template <class Visit>
HWY_INLINE void for_each_bit(std::uint64_t bits, const Visit& visit) {
  if (bits == (std::uint64_t{1} << kLanes) - 1) {
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      visit(lane);
    return;
  }
  for (; bits != 0; bits &= bits - 1)
    visit(static_cast<std::size_t>(std::countr_zero(bits)));
}

/// Snaps a vector of points and lowers their pixels one by one, without a branch that depends on
/// the pixel. (Gathering the pixels' depths first, to lower only those that win, was slower but for
/// AVX-512 and points in random order.)
template <bool kIsCentral, bool kIsBanded>
KernelReport draw_all(const RowTransform& rows, std::span<const Vec3f> positions,
                      PrimitiveId first_id, const DrawTarget& target) {
  const Ints d;
  const IntVec width = hn::Set(d, target.extent.width), height = hn::Set(d, target.extent.height);
  const IntVec below = hn::Set(d, -1);
  const IntVec depths_end = hn::Set(d, static_cast<std::int32_t>(kMaxDepth + 1));
  PixelKey* const keys = target.keys.data();
  struct {
    alignas(64) std::array<std::int32_t, kLanes> pixel, depth;
  } found;
  KernelReport report;
  for (; report.processed + kLanes <= positions.size(); report.processed += kLanes) {
    const Lanes p = load(&positions[report.processed]);
    const SnappedLanes s = snap_lanes<kIsCentral>(rows, p);
    report.rejected += kLanes - hn::CountTrue(d, s.valid);
    const IntVec x = hn::ShiftRight<kSubpixelBits>(s.x), y = hn::ShiftRight<kSubpixelBits>(s.y);
    Mask drawn = is_inside(rows, p, s.valid);
    drawn = hn::And(drawn, hn::And(hn::Gt(x, below), hn::Lt(x, width)));
    drawn = hn::And(drawn, hn::And(hn::Gt(y, below), hn::Lt(y, height)));
    drawn = hn::And(drawn, hn::And(hn::Gt(s.z, below), hn::Lt(s.z, depths_end)));
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

using Keys = hn::ScalableTag<PixelKey>;

/// Lowers a square of pixels, wholly on screen, to a key. The vectors reach past the square, where
/// they write what they read, and past the last pixel into the padding.
HWY_INLINE void lower_square(PixelKey* corner, std::size_t width, std::size_t size, PixelKey key) {
  const Keys d;
  const auto wanted = hn::Set(d, key);
  for (std::size_t y = 0; y < size; ++y, corner += width) {
    for (std::size_t x = 0; x < size; x += hn::Lanes(d)) {
      const auto now = hn::LoadU(d, corner + x);
      const auto in_square = hn::FirstN(d, size - x);
      hn::StoreU(hn::IfThenElse(in_square, hn::Min(now, wanted), now), d, corner + x);
    }
  }
}

/// The part of a square that is on screen.
void lower_part(const DrawTarget& target, int x, int y, int size, PixelKey key) {
  const PixelRange columns = on_screen({x, x + size - 1}, target.extent.width);
  const PixelRange rows = on_screen({y, y + size - 1}, target.extent.height);
  for (int row = rows.first; row <= rows.last; ++row) {
    for (int column = columns.first; column <= columns.last; ++column) {
      PixelKey& now = target.keys[target.extent.index({column, row})];
      now = std::min(now, key);
    }
  }
}

template <bool kIsCentral>
KernelReport draw_all_squares(const RowTransform& rows, std::span<const Vec3f> positions, int size,
                              PrimitiveId first_id, const DrawTarget& target) {
  const Ints d;
  const IntVec below = hn::Set(d, -1);
  const IntVec depths_end = hn::Set(d, static_cast<std::int32_t>(kMaxDepth + 1));
  const IntVec to_corner = hn::Set(d, kHalfPixel * (size - 1));
  const IntVec beyond = hn::Set(d, -size);
  const IntVec width = hn::Set(d, target.extent.width), height = hn::Set(d, target.extent.height);
  const int last_x = target.extent.width - size, last_y = target.extent.height - size;
  alignas(64) std::array<std::int32_t, kLanes> xs, ys, zs;
  KernelReport report;
  for (; report.processed + kLanes <= positions.size(); report.processed += kLanes) {
    const Lanes p = load(&positions[report.processed]);
    const SnappedLanes s = snap_lanes<kIsCentral>(rows, p);
    report.rejected += kLanes - hn::CountTrue(d, s.valid);
    const IntVec x = hn::ShiftRight<kSubpixelBits>(hn::Sub(s.x, to_corner));
    const IntVec y = hn::ShiftRight<kSubpixelBits>(hn::Sub(s.y, to_corner));
    Mask drawn = is_inside(rows, p, s.valid);
    drawn = hn::And(drawn, hn::And(hn::Gt(x, beyond), hn::Lt(x, width)));
    drawn = hn::And(drawn, hn::And(hn::Gt(y, beyond), hn::Lt(y, height)));
    drawn = hn::And(drawn, hn::And(hn::Gt(s.z, below), hn::Lt(s.z, depths_end)));
    hn::Store(x, d, xs.data());
    hn::Store(y, d, ys.data());
    hn::Store(s.z, d, zs.data());
    const auto base = first_id + static_cast<PrimitiveId>(report.processed);
    for_each_bit(bits_of(drawn), [&](std::size_t i) {
      const PixelKey key =
          make_key(static_cast<std::uint32_t>(zs[i]), base + static_cast<PrimitiveId>(i));
      if (xs[i] >= 0 && xs[i] <= last_x && ys[i] >= 0 && ys[i] <= last_y) {
        lower_square(&target.keys[target.extent.index({xs[i], ys[i]})],
                     static_cast<std::size_t>(target.extent.width), static_cast<std::size_t>(size),
                     key);
      } else {
        lower_part(target, xs[i], ys[i], size, key);
      }
    });
  }
  return report;
}

KernelReport draw_squares(const RowTransform& rows, std::span<const Vec3f> positions, int size,
                          PrimitiveId first_id, const DrawTarget& target) {
  return rows.is_central ? draw_all_squares<true>(rows, positions, size, first_id, target)
                         : draw_all_squares<false>(rows, positions, size, first_id, target);
}

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

SimdKernels make_kernels() {
  SimdKernels kernels{hwy::TargetName(HWY_TARGET), &snap, &draw_single_pixels, nullptr,
                      &draw_squares};
#if HWY_MAX_BYTES >= 32
  kernels.add_moments = &add_moments;
#endif
  return kernels;
}

#else

SimdKernels make_kernels() {
  return {};
}

#endif

}  // namespace rangezip::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace rangezip {

HWY_EXPORT(make_kernels);

namespace {

std::vector<SimdKernels> find_kernels() {
  std::vector<SimdKernels> found;
#if (HWY_TARGETS & (HWY_TARGETS - 1)) == 0
  found.push_back(HWY_STATIC_DISPATCH(make_kernels)());
#else
  std::int64_t left = hwy::SupportedTargets();
  // The lower the bit, the wider the instructions.
  for (; left != 0; left &= left - 1) {
    hwy::ChosenTarget chosen;
    chosen.Update(left & -left);
    const auto make = HWY_DISPATCH_TABLE(make_kernels)[chosen.GetIndex()];
    if (make != nullptr) found.push_back(make());
  }
#endif
  std::erase_if(found, [](const SimdKernels& kernels) { return kernels.name.empty(); });
  return found;
}

}  // namespace

const std::vector<SimdKernels>& simd_kernels() {
  static const std::vector<SimdKernels> kernels = find_kernels();
  return kernels;
}

}  // namespace rangezip

#endif  // HWY_ONCE
