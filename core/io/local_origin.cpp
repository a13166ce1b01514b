#include "core/io/local_origin.h"

#include <algorithm>
#include <cmath>

namespace rangezip {

namespace {

/// Beyond this the sample is thinned to every second of its positions. Medians of a few thousand
/// positions lie well within the data, which is all that is asked of them.
constexpr std::size_t kMostSamples = 4096;

constexpr double kLargestStep = 1.0;

/// Rounding goes up from this share of a step on. Not one half, where symmetric models have their
/// centre: the last bits of a moved coordinate would decide.
constexpr double kRoundUpFrom = 0.5703125;

struct Spread {
  double median = 0.0;
  double middle_half = 0.0;  ///< between the quartiles
  double range = 0.0;
};

Spread spread_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t count = values.size();
  return {.median = values[count / 2],
          .middle_half = values[3 * count / 4] - values[count / 4],
          .range = values.back() - values.front()};
}

/// The smallest power of two that is not below `size`, at most kLargestStep.
double lattice_step(double size) {
  if (!(size > 0.0) || size >= kLargestStep) return kLargestStep;
  int exponent = 0;
  const double mantissa = std::frexp(size, &exponent);  // in [0.5, 1)
  return std::ldexp(1.0, mantissa == 0.5 ? exponent - 1 : exponent);
}

}  // namespace

LocalOrigin::LocalOrigin() {
  sample_.reserve(kMostSamples);
}

std::size_t LocalOrigin::stride_of(std::size_t count) {
  std::size_t stride = 1;
  while (count > kMostSamples * stride)
    stride *= 2;
  return stride;
}

void LocalOrigin::take(const Vec3& position) {
  if (sample_.size() == kMostSamples) {
    for (std::size_t i = 0; 2 * i < kMostSamples; ++i)
      sample_[i] = sample_[2 * i];
    sample_.resize(kMostSamples / 2);
    stride_ *= 2;
  }
  sample_.push_back(position);
  until_next_ = stride_;
}

Vec3 LocalOrigin::origin() const {
  if (sample_.empty()) return Vec3{0.0};
  Vec3 median{0.0};
  double middle_half = 0.0;
  double range = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    values.reserve(sample_.size());
    for (const Vec3& p : sample_)
      values.push_back(p[axis]);
    const Spread spread = spread_of(std::move(values));
    median[axis] = spread.median;
    middle_half = std::max(middle_half, spread.middle_half);
    range = std::max(range, spread.range);
  }
  // The quartiles of evenly spread data are half of the size apart. Twice the size keeps most data
  // that are near zero at the origin 0 and costs the floats two bits at most.
  const double step = lattice_step(middle_half > 0.0 ? 4.0 * middle_half : 2.0 * range);
  Vec3 origin{0.0};
  for (int axis = 0; axis < 3; ++axis) {
    const double steps = std::floor(median[axis] / step + (1.0 - kRoundUpFrom));
    origin[axis] = steps * step + 0.0;  // no negative zero
  }
  return origin;
}

}  // namespace rangezip
