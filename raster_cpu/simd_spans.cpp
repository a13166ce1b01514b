// R6, R7 and R9 for the largest triangles, by vectors of the pixels of a span.
#include "raster_cpu/simd_kernels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "raster_cpu/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster_cpu/simd_spans.cpp"  // NOLINT
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "raster_cpu/simd_lanes-inl.h"
#include "raster_cpu/triangle_setup.h"

HWY_BEFORE_NAMESPACE();
namespace rangezip::HWY_NAMESPACE {
#if RANGEZIP_HAS_VECTORS
namespace {

using Longs = hn::ScalableTag<std::int64_t>;
using LongVec = hn::Vec<Longs>;
constexpr std::size_t kLongs = hn::MaxLanes(Longs());

/// One edge over the pixels of a triangle's box, row by row.
class EdgeWalk {
 public:
  EdgeWalk(const EdgeFunction<std::int64_t>& edge, std::int32_t x, std::int32_t y)
      : margin_(edge.at(x, y) - edge.least_inside()),
        step_x_(edge.minus_dy * kSubpixels),
        step_y_(edge.dx * kSubpixels),
        per_step_(step_x_ == 0 ? 0.0 : 1.0 / static_cast<double>(std::abs(step_x_))) {}

  void to_next_row() { margin_ += step_y_; }

  /// The part of `span`, columns counted from the box's first, that is inside.
  ///
  /// Half a unit added to the margin makes the product's floor exact: the quotient is then at least
  /// 2^-32 away from an integer, and where it is below 2^14, errs by less than 2^-37. What is
  /// larger lies off the image, whatever it is.
  [[nodiscard]] PixelRange clip(PixelRange span) const {
    if (step_x_ > 0 && margin_ < 0) {
      const double enter = std::floor((static_cast<double>(-margin_) - 0.5) * per_step_) + 1.0;
      span.first = std::max(span.first, to_column(enter));
    } else if (step_x_ < 0 && margin_ >= 0) {
      const double leave = std::floor((static_cast<double>(margin_) + 0.5) * per_step_);
      span.last = std::min(span.last, to_column(leave));
    } else if (margin_ < 0) {
      return {};
    }
    return span;
  }

 private:
  static int to_column(double column) {
    return static_cast<int>(std::min(column, static_cast<double>(1 << 14)));
  }

  std::int64_t margin_;  ///< how far inside the first pixel's centre lies, below 2^47
  std::int64_t step_x_;
  std::int64_t step_y_;
  double per_step_;
};

/// The exact depth over a triangle's box.
class DepthWalk {
 public:
  explicit DepthWalk(const TriangleSetup& t)
      : area_(t.area), per_area_(1.0 / static_cast<double>(t.area)) {
    const auto edges = edges_of<std::int64_t>(t);
    const std::array<std::int64_t, 3> z{std::int64_t{t.a.z} - t.z_min,
                                        std::int64_t{t.b.z} - t.z_min,
                                        std::int64_t{t.c.z} - t.z_min};
    std::array<std::int64_t, 3> at_first{};
    std::int64_t across = 0, up = 0;  // below 3 * 2^31 * 2^26
    for (std::size_t i = 0; i < 3; ++i) {
      at_first[i] = edges[i].at(pixel_center(t.columns.first), pixel_center(t.rows.first));
      across += edges[i].minus_dy * kSubpixels * z[i];
      up += edges[i].dx * kSubpixels * z[i];
    }
    row_ = divide_depth(at_first, z, area_);
    row_.value += t.z_min;
    step_x_ = divide_down(across, area_);
    step_y_ = divide_down(up, area_);
  }

  void to_next_row() { row_ = sum(row_, step_y_); }

  /// At a column counted from the box's first, below 2^14. @cost no division
  [[nodiscard]] ExactDepth at(int column) const {
    // The remainder is below 2^60: its quotient by the area, found in double, is at most one off.
    ExactDepth d{row_.value + column * step_x_.value, row_.remainder + column * step_x_.remainder};
    const auto carry = static_cast<std::int64_t>(static_cast<double>(d.remainder) * per_area_);
    d.value += carry;
    d.remainder -= carry * area_;
    if (d.remainder < 0) return {d.value - 1, d.remainder + area_};
    if (d.remainder >= area_) return {d.value + 1, d.remainder - area_};
    return d;
  }

  [[nodiscard]] ExactDepth step_x() const { return step_x_; }
  [[nodiscard]] ExactDepth sum(const ExactDepth& a, const ExactDepth& b) const {
    const ExactDepth s{a.value + b.value, a.remainder + b.remainder};
    return s.remainder >= area_ ? ExactDepth{s.value + 1, s.remainder - area_} : s;
  }

 private:
  std::int64_t area_;
  double per_area_;
  ExactDepth row_;  ///< at the first column
  ExactDepth step_x_;
  ExactDepth step_y_;
};

/// Depths of neighbouring pixels, one a lane.
class DepthLanes {
 public:
  DepthLanes(const DepthWalk& walk, std::int64_t area) : area_(hn::Set(d_, area)) {
    ExactDepth offset;
    for (std::size_t lane = 0; lane < kLongs; ++lane) {
      values_[lane] = offset.value;
      remainders_[lane] = offset.remainder;
      offset = walk.sum(offset, walk.step_x());
    }
    next_ = offset;
  }

  /// Calls visit(values, first column) for vectors of depths from `first` on.
  template <class Visit>
  HWY_INLINE void for_each(const ExactDepth& at_first, PixelRange span, const Visit& visit) const {
    LongVec value = hn::Add(hn::Load(d_, values_.data()), hn::Set(d_, at_first.value));
    LongVec remainder = hn::Add(hn::Load(d_, remainders_.data()), hn::Set(d_, at_first.remainder));
    const LongVec value_step = hn::Set(d_, next_.value);
    const LongVec remainder_step = hn::Set(d_, next_.remainder);
    for (int x = span.first; x <= span.last; x += static_cast<int>(kLongs)) {
      const auto is_over = hn::Not(hn::Lt(remainder, area_));
      remainder = hn::Sub(remainder, hn::IfThenElseZero(is_over, area_));
      value = hn::Sub(value, hn::VecFromMask(d_, is_over));
      visit(value, x);
      value = hn::Add(value, value_step);
      remainder = hn::Add(remainder, remainder_step);
    }
  }

 private:
  Longs d_;
  LongVec area_;
  alignas(64) std::array<std::int64_t, kLongs> values_;
  alignas(64) std::array<std::int64_t, kLongs> remainders_;
  ExactDepth next_;  ///< from vector to vector
};

/// Finds the covered span of each row, then carries R7's quotient and remainder from vector to
/// vector. Reads past spans and writes there what it read.
void fill_spans(const TriangleSetup& t, PrimitiveId id, const DrawTarget& target) {
  const hn::Rebind<PixelKey, Longs> dk;
  const auto ids = hn::Set(dk, PixelKey{id});
  const auto edges = edges_of<std::int64_t>(t);
  const std::int32_t x0 = pixel_center(t.columns.first), y0 = pixel_center(t.rows.first);
  std::array<EdgeWalk, 3> walks{EdgeWalk(edges[0], x0, y0), EdgeWalk(edges[1], x0, y0),
                                EdgeWalk(edges[2], x0, y0)};
  DepthWalk depth(t);
  const DepthLanes lanes(depth, t.area);
  for (int y = t.rows.first; y <= t.rows.last; ++y) {
    PixelRange span{0, t.columns.count() - 1};
    for (EdgeWalk& edge : walks) {
      if (!span.is_empty()) span = edge.clip(span);
      edge.to_next_row();
    }
    if (!span.is_empty()) {
      PixelKey* const row = target.keys.data() + target.extent.index({t.columns.first, y});
      lanes.for_each(depth.at(span.first), span, [&](LongVec depths, int x) {
        const auto keys = hn::Or(hn::ShiftLeft<32>(hn::BitCast(dk, depths)), ids);
        const auto now = hn::LoadU(dk, row + x);
        const auto covered = hn::FirstN(dk, static_cast<std::size_t>(span.last - x + 1));
        hn::StoreU(hn::IfThenElse(covered, hn::Min(now, keys), now), dk, row + x);
      });
    }
    depth.to_next_row();
  }
}

}  // namespace
#endif

void add_span_kernels([[maybe_unused]] SimdKernels& kernels) {
#if RANGEZIP_HAS_VECTORS
  kernels.fill_spans = &fill_spans;
#endif
}

}  // namespace rangezip::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace rangezip {

HWY_EXPORT(add_span_kernels);

void add_span_kernels(std::size_t target, SimdKernels& kernels) {
  const auto add = HWY_DISPATCH_TABLE(add_span_kernels)[target];
  if (add != nullptr) add(kernels);
}

}  // namespace rangezip

#endif  // HWY_ONCE
