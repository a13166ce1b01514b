// R6, R7, R9 and R12 by vectors of triangles, and of the pixels of one triangle.
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
#if HWY_TARGET != HWY_SCALAR
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
    draw_boxes(p, hn::Abs(area), columns, rows, drawn,
               item_.first_id + static_cast<PrimitiveId>(at));
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

  /// All lanes walk through their boxes in step, as far as the largest.
  HWY_INLINE void draw_boxes(const Corners& p, IntVec area, const RangeLanes& columns,
                             const RangeLanes& rows, Mask drawn, PrimitiveId first_id) {
    const Ints d;
    const IntVec half = hn::Set(d, kHalfPixel), zero = hn::Zero(d), one = hn::Set(d, 1);
    const IntVec x = hn::Add(hn::ShiftLeft<kSubpixelBits>(columns.first), half);
    const IntVec y = hn::Add(hn::ShiftLeft<kSubpixelBits>(rows.first), half);
    const EdgeLanes edge_a = edge_at(p.x[1], p.y[1], p.x[2], p.y[2], x, y);
    const EdgeLanes edge_b = edge_at(p.x[2], p.y[2], p.x[0], p.y[0], x, y);
    const EdgeLanes edge_c = edge_at(p.x[0], p.y[0], p.x[1], p.y[1], x, y);
    const hn::Half<Ints> half_d;
    const DepthLanes low(hn::LowerHalf(half_d, p.z[0]), hn::LowerHalf(half_d, p.z[1]),
                         hn::LowerHalf(half_d, p.z[2]), hn::LowerHalf(half_d, area));
    const DepthLanes high(hn::UpperHalf(half_d, p.z[0]), hn::UpperHalf(half_d, p.z[1]),
                          hn::UpperHalf(half_d, p.z[2]), hn::UpperHalf(half_d, area));
    IntVec row_a = edge_a.value, row_b = edge_b.value, row_c = edge_c.value;
    IntVec rows_left = hn::IfThenElseZero(drawn, hn::Add(hn::Sub(rows.last, rows.first), one));
    const IntVec width = hn::Add(hn::Sub(columns.last, columns.first), one);
    IntVec row_pixel =
        hn::Add(hn::Mul(rows.first, hn::Set(d, target_.extent.width)), columns.first);
    for (;;) {
      const Mask in_rows = hn::Gt(rows_left, zero);
      if (hn::AllFalse(d, in_rows)) return;
      IntVec columns_left = hn::IfThenElseZero(in_rows, width);
      IntVec a = row_a, b = row_b, c = row_c, pixel = row_pixel;
      for (;;) {
        const Mask in_columns = hn::Gt(columns_left, zero);
        if (hn::AllFalse(d, in_columns)) break;
        const IntVec margins =
            hn::Or(hn::Or(hn::Sub(a, edge_a.least_inside), hn::Sub(b, edge_b.least_inside)),
                   hn::Sub(c, edge_c.least_inside));
        const unsigned inside = bits_of(hn::AndNot(hn::Lt(margins, zero), in_columns));
        if (inside != 0) {
          const IntVec depth =
              hn::Combine(d, high.at(hn::UpperHalf(half_d, a), hn::UpperHalf(half_d, b)),
                          low.at(hn::LowerHalf(half_d, a), hn::LowerHalf(half_d, b)));
          lower_keys(inside, pixel, depth, first_id);
        }
        a = hn::Add(a, edge_a.step_x);
        b = hn::Add(b, edge_b.step_x);
        c = hn::Add(c, edge_c.step_x);
        pixel = hn::Add(pixel, one);
        columns_left = hn::Sub(columns_left, one);
      }
      row_a = hn::Add(row_a, edge_a.step_y);
      row_b = hn::Add(row_b, edge_b.step_y);
      row_c = hn::Add(row_c, edge_c.step_y);
      row_pixel = hn::Add(row_pixel, hn::Set(d, target_.extent.width));
      rows_left = hn::Sub(rows_left, one);
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

/// Doubles for the pixels of a row, keys beside them.
using Doubles = hn::ScalableTag<double>;
using Longs = hn::Rebind<std::int64_t, Doubles>;
using Keys = hn::Rebind<PixelKey, Doubles>;
using DoubleVec = hn::Vec<Doubles>;

/// A linear function over the pixels of a triangle's box, by vectors of pixels along a row. All its
/// values are integers, or halves of them, that doubles hold.
class PixelFunction {
 public:
  PixelFunction(double at_first, double step_x, double step_y)
      : row_(at_first),
        step_y_(step_y),
        across_(hn::Mul(hn::Iota(d_, 0.0), hn::Set(d_, step_x))),
        step_(hn::Set(d_, step_x * static_cast<double>(hn::Lanes(d_)))),
        now_(across_) {}

  HWY_INLINE void to_row_start() { now_ = hn::Add(hn::Set(d_, row_), across_); }
  HWY_INLINE void to_next_pixels() { now_ = hn::Add(now_, step_); }
  HWY_INLINE void to_next_row() { row_ += step_y_; }
  [[nodiscard]] HWY_INLINE DoubleVec now() const { return now_; }

 private:
  Doubles d_;
  double row_;
  double step_y_;
  DoubleVec across_;
  DoubleVec step_;
  DoubleVec now_;
};

/// Tests all pixels of a triangle's box, a vector along a row at a time (R6, R7, R9). Reads
/// past the box and writes there what it read.
void fill_box(const TriangleSetup& t, PrimitiveId id, const DrawTarget& target) {
  const Doubles d;
  const Longs dl;
  const Keys dk;
  const auto edges = edges_of<std::int64_t>(t);
  const DepthPlane plane(t);
  const std::int32_t x0 = pixel_center(t.columns.first), y0 = pixel_center(t.rows.first);
  // The first pixel's value and the steps to its neighbours.
  const auto edge_function = [&](std::size_t i) {
    const auto least = static_cast<double>(edges[i].least_inside());
    return PixelFunction(static_cast<double>(edges[i].at(x0, y0)) - least,
                         static_cast<double>(edges[i].minus_dy * kSubpixels),
                         static_cast<double>(edges[i].dx * kSubpixels));
  };
  const auto numerator = [&](double e_a, double e_b) {
    return e_a * plane.z_a_c + e_b * plane.z_b_c;
  };
  PixelFunction margin_a = edge_function(0), margin_b = edge_function(1),
                margin_c = edge_function(2);
  PixelFunction shifted(numerator(static_cast<double>(edges[0].at(x0, y0)),
                                  static_cast<double>(edges[1].at(x0, y0))) +
                            plane.addend,
                        numerator(static_cast<double>(edges[0].minus_dy * kSubpixels),
                                  static_cast<double>(edges[1].minus_dy * kSubpixels)),
                        numerator(static_cast<double>(edges[0].dx * kSubpixels),
                                  static_cast<double>(edges[1].dx * kSubpixels)));
  const DoubleVec per_area = hn::Set(d, plane.per_area);
  const DoubleVec to_low_bits = hn::Set(d, plane.depth_in_low_bits);
  const auto ids = hn::Set(dk, PixelKey{id});
  const auto columns = static_cast<std::size_t>(t.columns.count());
  for (int y = t.rows.first; y <= t.rows.last; ++y) {
    margin_a.to_row_start();
    margin_b.to_row_start();
    margin_c.to_row_start();
    shifted.to_row_start();
    const std::size_t row = target.extent.index({t.columns.first, y});
    for (std::size_t x = 0; x < columns; x += hn::Lanes(d)) {
      const auto signs =
          hn::BitCast(dl, hn::Or(hn::Or(margin_a.now(), margin_b.now()), margin_c.now()));
      const auto inside = hn::AndNot(hn::Lt(signs, hn::Zero(dl)), hn::FirstN(dl, columns - x));
      if (!hn::AllFalse(dl, inside)) {
        const auto sum = hn::Add(hn::Mul(shifted.now(), per_area), to_low_bits);
        const auto depth = hn::ShiftLeft<32>(hn::BitCast(dk, sum));
        PixelKey* const at = target.keys.data() + row + x;
        const auto now = hn::LoadU(dk, at);
        const auto lowered = hn::Min(now, hn::Or(depth, ids));
        hn::StoreU(hn::IfThenElse(hn::RebindMask(dk, inside), lowered, now), dk, at);
      }
      margin_a.to_next_pixels();
      margin_b.to_next_pixels();
      margin_c.to_next_pixels();
      shifted.to_next_pixels();
    }
    margin_a.to_next_row();
    margin_b.to_next_row();
    margin_c.to_next_row();
    shifted.to_next_row();
  }
}

}  // namespace
#endif

void add_triangle_kernels([[maybe_unused]] SimdKernels& kernels) {
#if HWY_TARGET != HWY_SCALAR
  kernels.draw_tiny_triangles = &draw_tiny_triangles;
  kernels.fill_box = &fill_box;
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
