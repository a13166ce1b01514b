#include "core/image/fill_holes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <string>

#include "core/base/error.h"
#include "core/base/parallel.h"

namespace rangezip {

namespace {

constexpr int kMinAveraged = 4;  ///< fewer depths of one sheet do not make a sample

/// The depths of a pixel's neighbours, nearest first.
class SortedDepths {
 public:
  void add(double depth) {
    std::size_t place = size_++;
    for (; place > 0 && depths_[place - 1] > depth; --place)
      depths_[place] = depths_[place - 1];
    depths_[place] = depth;
  }
  [[nodiscard]] std::span<const double> get() const {
    return std::span<const double>(depths_).first(size_);
  }

 private:
  std::array<double, 8> depths_{};
  std::size_t size_ = 0;
};

/// Mean depth of the nearest sheet around a pixel, or kNoSample if too few neighbours show it.
double depth_from_neighbours(const RangeImage& image, Pixel pixel,
                             const FillHolesOptions& options) {
  SortedDepths sorted;
  for (int y = pixel.y - 1; y <= pixel.y + 1; ++y) {
    for (int x = pixel.x - 1; x <= pixel.x + 1; ++x) {
      const Pixel there{x, y};
      if (image.extent().contains(there) && image.has_sample(there)) sorted.add(image[there]);
    }
  }
  const std::span<const double> depths = sorted.get();
  if (static_cast<int>(depths.size()) < options.min_neighbours) return kNoSample;
  const double max_step = options.max_step * image.view().pixel_size(depths[0]);
  double sum = depths[0];
  std::size_t used = 1;
  for (; used < depths.size() && depths[used] - depths[used - 1] <= max_step; ++used) {
    sum += depths[used];
  }
  const int count = static_cast<int>(used);
  return count < std::min(kMinAveraged, options.min_neighbours) ? kNoSample : sum / count;
}

/// The nearest sample from a pixel in one direction.
struct Bank {
  int steps = 0;  ///< 0: there is none within reach
  double depth = 0.0;
};

/// Two samples with the pixel between them, and its depth on the line that joins them.
struct Bridge {
  double length = std::numeric_limits<double>::infinity();  ///< pixels
  double depth = kNoSample;
};

/// Finds the shortest bridges over pixels without a sample.
class Bridges {
 public:
  Bridges(const RangeImage& image, const FillHolesOptions& options)
      : image_(image), options_(options) {}

  /// The depth of the shortest bridge, or kNoSample.
  [[nodiscard]] double depth_at(Pixel pixel) const {
    Bridge shortest;
    for (const Pixel step : {Pixel{1, 0}, Pixel{0, 1}, Pixel{1, 1}, Pixel{1, -1}}) {
      const Bridge bridge = bridge_along(pixel, step);
      if (bridge.length < shortest.length) shortest = bridge;
    }
    return shortest.depth;
  }

 private:
  [[nodiscard]] Bank bank_along(Pixel pixel, Pixel step) const {
    for (int steps = 1; steps < options_.reach; ++steps) {
      const Pixel there{pixel.x + steps * step.x, pixel.y + steps * step.y};
      if (!image_.extent().contains(there)) break;
      if (image_.has_sample(there)) return {steps, image_[there]};
    }
    return {};
  }

  [[nodiscard]] Bridge bridge_along(Pixel pixel, Pixel step) const {
    const Bank before = bank_along(pixel, {-step.x, -step.y});
    if (before.steps == 0) return {};
    const Bank after = bank_along(pixel, step);
    if (after.steps == 0) return {};
    const double pixels_per_step = step.x != 0 && step.y != 0 ? std::numbers::sqrt2 : 1.0;
    const int steps = before.steps + after.steps;
    const double length = pixels_per_step * steps;
    const double max_step = options_.max_step * image_.view().pixel_size(before.depth);
    if (length > options_.reach || std::abs(after.depth - before.depth) > max_step * length)
      return {};
    return {length, before.depth + (after.depth - before.depth) * before.steps / steps};
  }

  const RangeImage& image_;
  const FillHolesOptions& options_;
};

/// Fills the pixels for which `depth_at(pixel)` is a depth.
template <class DepthAt>
void fill(FillHolesResult& result, const DepthAt& depth_at) {
  for_each_row(result.image.extent().height, [&](int y) {
    for (Pixel p{0, y}; p.x < result.image.extent().width; ++p.x) {
      if (result.image.has_sample(p)) continue;
      const double depth = depth_at(p);
      if (depth == kNoSample) continue;
      result.image[p] = depth;
      result.filled[p] = 1;
    }
  });
}

}  // namespace

FillHolesResult fill_holes(const RangeImage& image, const FillHolesOptions& options) {
  if (options.min_neighbours < 1 || options.min_neighbours > 8) {
    throw InvalidArgument("fill_holes: min_neighbours must lie in 1..8, got " +
                          std::to_string(options.min_neighbours));
  }
  if (options.rounds < 0) {
    throw InvalidArgument("fill_holes: rounds must not be negative, got " +
                          std::to_string(options.rounds));
  }
  if (options.reach < 0) {
    throw InvalidArgument("fill_holes: reach must not be negative, got " +
                          std::to_string(options.reach));
  }
  FillHolesResult result{.image = image, .filled = Mask(image.extent(), 0)};
  if (options.reach > 0) {
    const Bridges bridges(image, options);
    fill(result, [&](Pixel p) { return bridges.depth_at(p); });
  }
  for (int round = 0; round < options.rounds; ++round) {
    const RangeImage before = result.image;
    fill(result, [&](Pixel p) { return depth_from_neighbours(before, p, options); });
  }
  return result;
}

}  // namespace rangezip
