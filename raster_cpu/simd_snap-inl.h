// Snapping by vectors, for each set of instructions: included by the files that Highway compiles
// once for each (#include <foreach_target.h>).

#if defined(RANGEZIP_SIMD_SNAP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RANGEZIP_SIMD_SNAP_INL_H
#undef RANGEZIP_SIMD_SNAP_INL_H
#else
#define RANGEZIP_SIMD_SNAP_INL_H
#endif

#include "core/raster/framebuffer.h"
#include "core/raster/row_transform.h"
#include "raster_cpu/fixed_point.h"
#include "raster_cpu/simd_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rangezip::HWY_NAMESPACE {
#if RANGEZIP_HAS_VECTORS
namespace {

/// Positions of a vector of points, one coordinate a vector. Like all structures of vectors here,
/// only made whole: on some targets a vector's default constructor can be called by functions
/// alone.
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
  FloatVec x, y, z;
  hn::LoadInterleaved3(d, &positions->x, x, y, z);
  return {x, y, z};
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

/// The nearest integer of |v| <= kGuardXY, ties to even; of anything else, some integer.
HWY_INLINE IntVec nearest_in_guard(FloatVec v) {
  // Where floats are a unit apart, their low bits are the nearest integer.
  static_assert(kGuardXY <= 1 << 22);
  const FloatVec unit_apart = hn::Set(Floats(), 0x1.8p23F);
  return hn::Sub(hn::BitCast(Ints(), hn::Add(v, unit_apart)), hn::BitCast(Ints(), unit_apart));
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
  return {nearest_in_guard(x), nearest_in_guard(y), hn::NearestInt(z),
          hn::RebindMask(Ints(), valid)};
}

/// R4 for lanes in double: floor(v / w + 1/2) of the exact quotient, given 1 / w.
///
/// It is rounded to nearest, and no correction is needed. Both v and w are floats, so a quotient
/// that is no tie is at least 2^-25 away from one: 2 v - (2 k + 1) w is a multiple of the lesser of
/// the spacings of floats at 2 v and at w, and near a tie neither is below w 2^-24. With
/// |v / w| <= 2^25 the product and the first sum here err by at most 2^-27 + 2^-28. An addend
/// between that and 2^-25 less that takes exact ties up, as R4 wants, and nothing else across.
template <class D>
HWY_INLINE hn::Vec<hn::Rebind<std::int32_t, D>> round_quotient(D d, hn::Vec<D> v,
                                                               hn::Vec<D> per_w) {
  const auto q = hn::Add(hn::Mul(v, per_w), hn::Set(d, 0x1p-26));
  // Where doubles are a unit apart, their low bits are the nearest integer.
  const auto integer = hn::Add(q, hn::Set(d, 0x1.8p52));
  const hn::Rebind<std::uint32_t, D> d32;
  const auto low = hn::TruncateTo(d32, hn::BitCast(hn::RebindToUnsigned<D>(), integer));
  return hn::BitCast(hn::RebindToSigned<decltype(d32)>(), low);
}

/// R4 for x, y and z over w.
HWY_INLINE SnappedLanes divide_by_w(FloatVec x, FloatVec y, FloatVec z, FloatVec w, Mask valid) {
  const hn::Repartition<double, Floats> d;
  const hn::Half<Floats> half;
  const auto one = hn::Set(d, 1.0);
  const auto per_low = hn::Div(one, hn::PromoteTo(d, hn::LowerHalf(half, w)));
  const auto per_high = hn::Div(one, hn::PromoteTo(d, hn::UpperHalf(half, w)));
  const auto quotients = [&](FloatVec v) {
    const auto low = round_quotient(d, hn::PromoteTo(d, hn::LowerHalf(half, v)), per_low);
    const auto high = round_quotient(d, hn::PromoteTo(d, hn::UpperHalf(half, v)), per_high);
    return hn::Combine(Ints(), high, low);
  };
  return {quotients(x), quotients(y), quotients(z), valid};
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
  return divide_by_w(x, y, z, w, hn::RebindMask(Ints(), valid));
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

/// Depths that are drawn.
HWY_INLINE Mask is_in_depth_range(IntVec z) {
  return is_below(z, static_cast<std::int32_t>(kMaxDepth) + 1);
}

template <bool kIsCentral>
HWY_INLINE SnappedLanes snap_lanes(const RowTransform& rows, const Lanes& p) {
  if constexpr (kIsCentral) {
    return snap_central(rows, p);
  } else {
    return snap_parallel(rows, p);
  }
}

}  // namespace
#endif
}  // namespace rangezip::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // RANGEZIP_SIMD_SNAP_INL_H
