// R6, R7, R9 and R12 for tiny triangles, by vectors of triangles.
#include "raster_cpu/simd_kernels.h"

#include <algorithm>
#include <array>
#include <bit>

#include "raster_cpu/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster_cpu/simd_triangles.cpp"  // NOLINT
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "raster_cpu/simd_snap-inl.h"
#include "raster_cpu/triangle_setup.h"

HWY_BEFORE_NAMESPACE();
namespace rangezip::HWY_NAMESPACE {
#if RANGEZIP_HAS_VECTORS
namespace {

/// Corners of a vector of triangles.
struct Corners {
  std::array<IntVec, 3> x, y, z;
};

/// The corners of kLanes triangles, by gathering from the snapped positions.
HWY_INLINE Corners gather_corners(std::span<const SnappedPosition> snapped, IntVec a, IntVec b,
                                  IntVec c) {
  static_assert(sizeof(SnappedPosition) == 3 * sizeof(std::int32_t));
  const Ints d;
  const auto gather = [&](const std::int32_t* coordinate, IntVec vertices) {
    const IntVec at = hn::Add(hn::Add(vertices, vertices), vertices);
    return hn::GatherIndex(d, coordinate, at);
  };
  const SnappedPosition* const first = snapped.data();
  return {{gather(&first->x, a), gather(&first->x, b), gather(&first->x, c)},
          {gather(&first->y, a), gather(&first->y, b), gather(&first->y, c)},
          {gather(&first->z, a), gather(&first->z, b), gather(&first->z, c)}};
}

HWY_INLINE IntVec least(const std::array<IntVec, 3>& v) {
  return hn::Min(hn::Min(v[0], v[1]), v[2]);
}
HWY_INLINE IntVec greatest(const std::array<IntVec, 3>& v) {
  return hn::Max(hn::Max(v[0], v[1]), v[2]);
}

/// First and last pixel whose centre lies between two coordinates, on screen.
struct RangeLanes {
  IntVec first, last;
};
HWY_INLINE RangeLanes centers_between(IntVec lower, IntVec upper, int size) {
  const Ints d;
  const IntVec half = hn::Set(d, kHalfPixel);
  const IntVec first = hn::ShiftRight<kSubpixelBits>(hn::Add(lower, hn::Sub(half, hn::Set(d, 1))));
  const IntVec last = hn::ShiftRight<kSubpixelBits>(hn::Sub(upper, half));
  return {hn::Max(first, hn::Zero(d)), hn::Min(last, hn::Set(d, size - 1))};
}

/// Edge values at the lanes' present pixels (R6).
struct EdgeLanes {
  IntVec value, step_x, step_y, least_inside;
};
HWY_INLINE EdgeLanes edge_at(IntVec from_x, IntVec from_y, IntVec to_x, IntVec to_y, IntVec x,
                             IntVec y) {
  const Ints d;
  const IntVec dx = hn::Sub(to_x, from_x), minus_dy = hn::Sub(from_y, to_y), zero = hn::Zero(d);
  const Mask owns =
      hn::Or(hn::Gt(minus_dy, zero), hn::And(hn::Eq(minus_dy, zero), hn::Gt(dx, zero)));
  return {hn::Add(hn::Mul(dx, hn::Sub(y, from_y)), hn::Mul(minus_dy, hn::Sub(x, from_x))),
          hn::ShiftLeft<kSubpixelBits>(minus_dy), hn::ShiftLeft<kSubpixelBits>(dx),
          hn::IfThenElse(owns, zero, hn::Set(d, 1))};
}

/// DepthPlane for half a vector of triangles.
class DepthLanes {
 public:
  using D = hn::Repartition<double, Floats>;
  using HalfInts = hn::Rebind<std::int32_t, D>;
  using HalfIntVec = hn::Vec<HalfInts>;

  DepthLanes(HalfIntVec z_a, HalfIntVec z_b, HalfIntVec z_c, HalfIntVec area)
      : z_a_c_(hn::PromoteTo(d_, hn::Sub(z_a, z_c))),
        z_b_c_(hn::PromoteTo(d_, hn::Sub(z_b, z_c))),
        addend_(hn::Mul(hn::Sub(hn::Set(d_, 1.0), hn::PromoteTo(d_, area)), hn::Set(d_, 0.5))),
        per_area_(hn::Div(hn::Set(d_, 1.0), hn::PromoteTo(d_, area))),
        to_low_bits_(hn::Add(hn::Set(d_, 0x1.8p52), hn::PromoteTo(d_, z_c))) {}

  [[nodiscard]] HWY_INLINE HalfIntVec at(HalfIntVec e_a, HalfIntVec e_b) const {
    const auto n =
        hn::Add(hn::Mul(hn::PromoteTo(d_, e_a), z_a_c_), hn::Mul(hn::PromoteTo(d_, e_b), z_b_c_));
    const auto sum = hn::Add(hn::Mul(hn::Add(n, addend_), per_area_), to_low_bits_);
    const hn::Rebind<std::uint32_t, D> d32;
    return hn::BitCast(HalfInts(),
                       hn::TruncateTo(d32, hn::BitCast(hn::RebindToUnsigned<D>(), sum)));
  }

 private:
  D d_;
  hn::Vec<D> z_a_c_, z_b_c_, addend_, per_area_, to_low_bits_;
};

/// Draws a vector of triangles at once, one a lane: those of at most kTinyBox x kTinyBox pixels.
template <class Accept>
class TinyTriangles {
 public:
  TinyTriangles(const DrawTriangles& item, std::span<const SnappedPosition> snapped,
                const DrawTarget& target, const Accept& accept)
      : item_(item), snapped_(snapped), target_(target), accept_(accept) {}

  /// The triangles from `at` on. @return a bit for each that is not tiny and may draw something
  HWY_INLINE unsigned draw(std::size_t at) {
    const Ints d;
    prefetch_after(item_.triangles, at);
    IntVec a, b, c;
    hn::LoadInterleaved3(d, reinterpret_cast<const std::int32_t*>(&item_.triangles[at]), a, b, c);
    Corners p = gather_corners(snapped_, a, b, c);

    const IntVec x_min = least(p.x), x_max = greatest(p.x);
    const IntVec y_min = least(p.y), y_max = greatest(p.y);
    const IntVec z_min = least(p.z), z_max = greatest(p.z);
    const Mask rejected = hn::Eq(x_min, hn::Set(d, kRejected.x));
    const RangeLanes columns = centers_between(x_min, x_max, target_.extent.width);
    const RangeLanes rows = centers_between(y_min, y_max, target_.extent.height);
    const IntVec far = hn::Set(d, static_cast<std::int32_t>(kMaxDepth)), zero = hn::Zero(d);
    Mask drawn =
        hn::Not(hn::Or(hn::Gt(columns.first, columns.last), hn::Gt(rows.first, rows.last)));
    drawn = hn::AndNot(hn::Or(hn::Lt(z_max, zero), hn::Gt(z_min, far)), drawn);
    const IntVec limit = hn::Set(d, kTinyBox * kSubpixels);
    Mask tiny = hn::And(hn::Lt(hn::Sub(x_max, x_min), limit), hn::Lt(hn::Sub(y_max, y_min), limit));
    tiny = hn::AndNot(hn::Or(hn::Lt(z_min, zero), hn::Gt(z_max, far)), tiny);
    const unsigned left = bits_of(hn::Or(rejected, hn::AndNot(tiny, drawn)));
    drawn = hn::AndNot(rejected, hn::And(drawn, tiny));

    // R6: counter-clockwise.
    const IntVec area = hn::Sub(hn::Mul(hn::Sub(p.x[1], p.x[0]), hn::Sub(p.y[2], p.y[0])),
                                hn::Mul(hn::Sub(p.y[1], p.y[0]), hn::Sub(p.x[2], p.x[0])));
    drawn = hn::And(drawn, is_facing(area));
    if (hn::AllFalse(d, drawn)) return left;
    const Mask turned = hn::Lt(area, zero);
    swap_where(turned, p.x[1], p.x[2]);
    swap_where(turned, p.y[1], p.y[2]);
    swap_where(turned, p.z[1], p.z[2]);
    const PrimitiveId first_id = item_.first_id + static_cast<PrimitiveId>(at);
    draw_boxes(set_up(p, hn::Abs(area), columns, rows, first_id), columns, rows, drawn);
    return left;
  }

 private:
  [[nodiscard]] HWY_INLINE Mask is_facing(IntVec area) const {
    const IntVec zero = hn::Zero(Ints());
    if (item_.facing == Facing::front) return hn::Gt(area, zero);
    if (item_.facing == Facing::back) return hn::Lt(area, zero);
    return hn::Ne(area, zero);
  }

  static HWY_INLINE void swap_where(Mask mask, IntVec& v, IntVec& w) {
    const IntVec old = v;
    v = hn::IfThenElse(mask, w, v);
    w = hn::IfThenElse(mask, old, w);
  }

  /// What the lanes' triangles give any of their pixels.
  struct Setup {
    EdgeLanes edge_a, edge_b, edge_c;
    DepthLanes depth_low, depth_high;
    PrimitiveId first_id;
  };

  static HWY_INLINE Setup set_up(const Corners& p, IntVec area, const RangeLanes& columns,
                                 const RangeLanes& rows, PrimitiveId first_id) {
    const Ints d;
    const hn::Half<Ints> half_d;
    const IntVec half = hn::Set(d, kHalfPixel);
    const IntVec x = hn::Add(hn::ShiftLeft<kSubpixelBits>(columns.first), half);
    const IntVec y = hn::Add(hn::ShiftLeft<kSubpixelBits>(rows.first), half);
    return {edge_at(p.x[1], p.y[1], p.x[2], p.y[2], x, y),
            edge_at(p.x[2], p.y[2], p.x[0], p.y[0], x, y),
            edge_at(p.x[0], p.y[0], p.x[1], p.y[1], x, y),
            DepthLanes(hn::LowerHalf(half_d, p.z[0]), hn::LowerHalf(half_d, p.z[1]),
                       hn::LowerHalf(half_d, p.z[2]), hn::LowerHalf(half_d, area)),
            DepthLanes(hn::UpperHalf(half_d, p.z[0]), hn::UpperHalf(half_d, p.z[1]),
                       hn::UpperHalf(half_d, p.z[2]), hn::UpperHalf(half_d, area)),
            first_id};
  }

  /// All lanes walk through the rows of their boxes in step, as far as the highest.
  HWY_INLINE void draw_boxes(const Setup& t, const RangeLanes& columns, const RangeLanes& rows,
                             Mask drawn) {
    const Ints d;
    const IntVec zero = hn::Zero(d), one = hn::Set(d, 1);
    const IntVec image_width = hn::Set(d, target_.extent.width);
    const IntVec width = hn::Add(hn::Sub(columns.last, columns.first), one);
    IntVec left = hn::IfThenElseZero(drawn, hn::Add(hn::Sub(rows.last, rows.first), one));
    IntVec a = t.edge_a.value, b = t.edge_b.value, c = t.edge_c.value;
    IntVec pixel = hn::Add(hn::Mul(rows.first, image_width), columns.first);
    for (;;) {
      const Mask in_rows = hn::Gt(left, zero);
      if (hn::AllFalse(d, in_rows)) return;
      draw_row(t, a, b, c, pixel, hn::IfThenElseZero(in_rows, width));
      a = hn::Add(a, t.edge_a.step_y);
      b = hn::Add(b, t.edge_b.step_y);
      c = hn::Add(c, t.edge_c.step_y);
      pixel = hn::Add(pixel, image_width);
      left = hn::Sub(left, one);
    }
  }

  /// The same along a row: `left` pixels from `pixel` on, where the edges are a, b and c.
  HWY_INLINE void draw_row(const Setup& t, IntVec a, IntVec b, IntVec c, IntVec pixel,
                           IntVec left) {
    const Ints d;
    const hn::Half<Ints> half_d;
    const IntVec zero = hn::Zero(d), one = hn::Set(d, 1);
    for (;;) {
      const Mask in_columns = hn::Gt(left, zero);
      if (hn::AllFalse(d, in_columns)) return;
      const IntVec margins =
          hn::Or(hn::Or(hn::Sub(a, t.edge_a.least_inside), hn::Sub(b, t.edge_b.least_inside)),
                 hn::Sub(c, t.edge_c.least_inside));
      const unsigned inside = bits_of(hn::AndNot(hn::Lt(margins, zero), in_columns));
      if (inside != 0) {
        const IntVec depth =
            hn::Combine(d, t.depth_high.at(hn::UpperHalf(half_d, a), hn::UpperHalf(half_d, b)),
                        t.depth_low.at(hn::LowerHalf(half_d, a), hn::LowerHalf(half_d, b)));
        lower_keys(inside, pixel, depth, t.first_id);
      }
      a = hn::Add(a, t.edge_a.step_x);
      b = hn::Add(b, t.edge_b.step_x);
      c = hn::Add(c, t.edge_c.step_x);
      pixel = hn::Add(pixel, one);
      left = hn::Sub(left, one);
    }
  }

  HWY_INLINE void lower_keys(unsigned inside, IntVec pixel, IntVec depth, PrimitiveId first_id) {
    alignas(64) std::array<std::int32_t, kLanes> pixels, depths;
    hn::Store(pixel, Ints(), pixels.data());
    hn::Store(depth, Ints(), depths.data());
    for (; inside != 0; inside &= inside - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(inside));
      const auto at = static_cast<std::size_t>(pixels[lane]);
      if (!accept_(at, depths[lane])) continue;
      const PixelKey key = make_key(static_cast<std::uint32_t>(depths[lane]),
                                    first_id + static_cast<PrimitiveId>(lane));
      target_.keys[at] = std::min(target_.keys[at], key);
    }
  }

  /// Pixels: larger boxes leave too many lanes idle.
  static constexpr int kTinyBox = 6;
  static_assert(2 * kTinyBox * kTinyBox < 1 << (31 - 2 * kSubpixelBits), "edges fit 32 bits");
  static_assert(6.0 * kTinyBox * kSubpixels * kTinyBox * kSubpixels * (kMaxDepth + 1.0) < 0x1p52,
                "fits_double()");

  const DrawTriangles& item_;
  std::span<const SnappedPosition> snapped_;
  const DrawTarget& target_;
  const Accept& accept_;
};

std::size_t draw_tiny_triangles(const DrawTriangles& item, std::span<const SnappedPosition> snapped,
                                std::size_t begin, std::size_t end, const DrawTarget& target,
                                std::vector<std::size_t>& left) {
  left.clear();
  std::size_t at = begin;
  with_acceptance(target, [&](const auto& accept) {
    TinyTriangles tiny(item, snapped, target, accept);
    for (; at + kLanes <= end; at += kLanes) {
      for (unsigned bits = tiny.draw(at); bits != 0; bits &= bits - 1)
        left.push_back(at + static_cast<std::size_t>(std::countr_zero(bits)));
    }
  });
  return at - begin;
}

}  // namespace
#endif

void add_triangle_kernels([[maybe_unused]] SimdKernels& kernels) {
#if RANGEZIP_HAS_VECTORS
  kernels.draw_tiny_triangles = &draw_tiny_triangles;
#endif
}

}  // namespace rangezip::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace rangezip {

HWY_EXPORT(add_triangle_kernels);

void add_triangle_kernels(std::size_t target, SimdKernels& kernels) {
  const auto add = HWY_DISPATCH_TABLE(add_triangle_kernels)[target];
  if (add != nullptr) add(kernels);
}

}  // namespace rangezip

#endif  // HWY_ONCE
