// R6, R7 and R9 for larger triangles, by vectors of the pixels of a row.
#include "raster_cpu/simd_kernels.h"

#include <cstdint>

#include "raster_cpu/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster_cpu/simd_boxes.cpp"  // NOLINT
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "raster_cpu/simd_lanes-inl.h"
#include "raster_cpu/triangle_setup.h"

HWY_BEFORE_NAMESPACE();
namespace rangezip::HWY_NAMESPACE {
#if RANGEZIP_HAS_VECTORS
namespace {

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

/// The functions of R6 and R7 over a triangle's box.
struct BoxFunctions {
  PixelFunction margin_a, margin_b, margin_c;  ///< edges less their least value inside
  PixelFunction depth;                         ///< n + (1 - area) / 2 of DepthPlane

  HWY_INLINE void to_row_start() {
    margin_a.to_row_start();
    margin_b.to_row_start();
    margin_c.to_row_start();
    depth.to_row_start();
  }
  HWY_INLINE void to_next_pixels() {
    margin_a.to_next_pixels();
    margin_b.to_next_pixels();
    margin_c.to_next_pixels();
    depth.to_next_pixels();
  }
  HWY_INLINE void to_next_row() {
    margin_a.to_next_row();
    margin_b.to_next_row();
    margin_c.to_next_row();
    depth.to_next_row();
  }
  /// True where R6 says inside. No value is ever -0, so the sign bits tell.
  [[nodiscard]] HWY_INLINE hn::Mask<Longs> is_inside() const {
    const Longs d;
    const auto signs =
        hn::BitCast(d, hn::Or(hn::Or(margin_a.now(), margin_b.now()), margin_c.now()));
    return hn::Not(hn::Lt(signs, hn::Zero(d)));
  }
};

/// An edge's value at the first pixel of a box and the steps to its neighbours.
struct EdgeSteps {
  double value, step_x, step_y, least_inside;

  EdgeSteps(const EdgeFunction<std::int64_t>& edge, std::int32_t x, std::int32_t y)
      : value(static_cast<double>(edge.at(x, y))),
        step_x(static_cast<double>(edge.minus_dy * kSubpixels)),
        step_y(static_cast<double>(edge.dx * kSubpixels)),
        least_inside(static_cast<double>(edge.least_inside())) {}
};

HWY_INLINE BoxFunctions functions_over_box(const TriangleSetup& t, const DepthPlane& plane) {
  const auto edges = edges_of<std::int64_t>(t);
  const std::int32_t x = pixel_center(t.columns.first), y = pixel_center(t.rows.first);
  const EdgeSteps a(edges[0], x, y), b(edges[1], x, y), c(edges[2], x, y);
  const auto margin = [](const EdgeSteps& e) {
    return PixelFunction(e.value - e.least_inside, e.step_x, e.step_y);
  };
  const auto n = [&](double e_a, double e_b) { return e_a * plane.z_a_c + e_b * plane.z_b_c; };
  return {margin(a), margin(b), margin(c),
          PixelFunction(n(a.value, b.value) + plane.addend, n(a.step_x, b.step_x),
                        n(a.step_y, b.step_y))};
}

/// Tests all pixels of a triangle's box, a vector along a row at a time (R6, R7, R9). Reads past
/// the box and writes there what it read.
void fill_box(const TriangleSetup& t, PrimitiveId id, const DrawTarget& target) {
  const Doubles d;
  const Longs dl;
  const Keys dk;
  const DepthPlane plane(t);
  BoxFunctions at = functions_over_box(t, plane);
  const DoubleVec per_area = hn::Set(d, plane.per_area);
  const DoubleVec to_low_bits = hn::Set(d, plane.depth_in_low_bits);
  const auto ids = hn::Set(dk, PixelKey{id});
  const auto columns = static_cast<std::size_t>(t.columns.count());
  for (int y = t.rows.first; y <= t.rows.last; ++y, at.to_next_row()) {
    PixelKey* const row = target.keys.data() + target.extent.index({t.columns.first, y});
    at.to_row_start();
    for (std::size_t x = 0; x < columns; x += hn::Lanes(d), at.to_next_pixels()) {
      const auto inside = hn::And(at.is_inside(), hn::FirstN(dl, columns - x));
      if (hn::AllFalse(dl, inside)) continue;
      const auto sum = hn::Add(hn::Mul(at.depth.now(), per_area), to_low_bits);
      const auto depth = hn::ShiftLeft<32>(hn::BitCast(dk, sum));
      const auto now = hn::LoadU(dk, row + x);
      const auto lowered = hn::Min(now, hn::Or(depth, ids));
      hn::StoreU(hn::IfThenElse(hn::RebindMask(dk, inside), lowered, now), dk, row + x);
    }
  }
}

}  // namespace
#endif

void add_box_kernels([[maybe_unused]] SimdKernels& kernels) {
#if RANGEZIP_HAS_VECTORS
  kernels.fill_box = &fill_box;
#endif
}

}  // namespace rangezip::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace rangezip {

HWY_EXPORT(add_box_kernels);

void add_box_kernels(std::size_t target, SimdKernels& kernels) {
  const auto add = HWY_DISPATCH_TABLE(add_box_kernels)[target];
  if (add != nullptr) add(kernels);
}

}  // namespace rangezip

#endif  // HWY_ONCE
