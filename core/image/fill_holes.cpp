#include "core/image/fill_holes.h"

#include <algorithm>
#include <array>
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
  FillHolesResult result{.image = image, .filled = Mask(image.extent(), 0)};
  for (int round = 0; round < options.rounds; ++round) {
    const RangeImage before = result.image;
    for_each_row(image.extent().height, [&](int y) {
      for (Pixel p{0, y}; p.x < image.extent().width; ++p.x) {
        if (before.has_sample(p)) continue;
        const double depth = depth_from_neighbours(before, p, options);
        if (depth == kNoSample) continue;
        result.image[p] = depth;
        result.filled[p] = 1;
      }
    });
  }
  return result;
}

}  // namespace rangezip
