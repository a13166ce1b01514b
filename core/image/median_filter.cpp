#include "core/image/median_filter.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"

namespace rangezip {

namespace {

/// @param window scratch memory
double median_around(const RangeImage& image, Pixel pixel, const MedianFilterOptions& options,
                     std::vector<double>& window) {
  const double here = image[pixel];
  const double max_step = options.max_step * image.view().pixel_size(here);
  const auto takes_part = [&](Pixel p) {
    return image.extent().contains(p) && image.has_sample(p) &&
           std::abs(image[p] - here) <= max_step;
  };
  window.assign(1, here);
  // One of each pair of opposite neighbours: the rows above, and the right half of this one.
  for (int dy = 0; dy <= options.radius; ++dy) {
    for (int dx = dy == 0 ? 1 : -options.radius; dx <= options.radius; ++dx) {
      const Pixel one{pixel.x + dx, pixel.y + dy};
      const Pixel opposite{pixel.x - dx, pixel.y - dy};
      if (!takes_part(one) || !takes_part(opposite)) continue;
      window.push_back(image[one]);
      window.push_back(image[opposite]);
    }
  }
  const auto middle = window.begin() + static_cast<std::ptrdiff_t>(window.size() / 2);
  std::nth_element(window.begin(), middle, window.end());
  return *middle;
}

}  // namespace

RangeImage median_filter(const RangeImage& image, const MedianFilterOptions& options) {
  if (options.radius < 1 || options.radius > MedianFilterOptions::kMostRadius) {
    throw InvalidArgument("median_filter: radius must lie in 1.." +
                          std::to_string(MedianFilterOptions::kMostRadius) + ", got " +
                          std::to_string(options.radius));
  }
  if (!(options.max_step > 0.0)) {
    throw InvalidArgument("median_filter: max_step must be positive, got " +
                          std::to_string(options.max_step));
  }
  RangeImage filtered = image;
  for_each_row(image.extent().height, [&](int y) {
    std::vector<double> window;
    for (Pixel p{0, y}; p.x < image.extent().width; ++p.x) {
      if (image.has_sample(p)) filtered[p] = median_around(image, p, options, window);
    }
  });
  return filtered;
}

}  // namespace rangezip
