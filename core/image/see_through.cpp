#include "core/image/see_through.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "core/base/error.h"
#include "core/base/parallel.h"

namespace rangezip {

namespace {

constexpr int kRadius = 2;             ///< of the window, pixels
constexpr int kMinCompatible = 3;      ///< neighbours that save a sample with nearer ones around
constexpr int kMinSectors = 6;         ///< of eight, with something nearer: surrounded
constexpr int kOutlierCompatible = 2;  ///< fewer make an outlier ...
constexpr int kOutlierNeighbours = 4;  ///< ... where there are as many samples to compare with

/// A pixel of the window, seen from its middle.
struct Neighbour {
  int dx = 0;
  int dy = 0;
  double distance = 0.0;     ///< pixels
  std::uint8_t sector = 0;   ///< one bit of eight
  bool is_adjacent = false;  ///< one of the eight around the middle
};

/// Sectors by the signs of the offsets: the four axes and the four quadrants between them, so
/// mirror images of the window have mirrored sectors.
constexpr std::uint8_t sector_of(int dx, int dy) {
  const auto sign = [](int v) { return v > 0 ? 1 : v < 0 ? -1 : 0; };
  const int place = 3 * (sign(dy) + 1) + sign(dx) + 1;  // 0..8 without 4, the middle
  return static_cast<std::uint8_t>(1U << (place < 4 ? place : place - 1));
}

std::array<Neighbour, 24> make_window() {
  std::array<Neighbour, 24> window;
  std::size_t i = 0;
  for (int dy = -kRadius; dy <= kRadius; ++dy) {
    for (int dx = -kRadius; dx <= kRadius; ++dx) {
      if (dx == 0 && dy == 0) continue;
      window[i++] = {.dx = dx,
                     .dy = dy,
                     .distance = std::sqrt(static_cast<double>(dx * dx + dy * dy)),
                     .sector = sector_of(dx, dy),
                     .is_adjacent = dx * dx <= 1 && dy * dy <= 1};
    }
  }
  return window;
}

/// Decides on single samples.
class SeeThroughRule {
 public:
  SeeThroughRule(const RangeImage& image, const SeeThroughOptions& options)
      : image_(image), options_(options), window_(make_window()) {}

  [[nodiscard]] bool removes(Pixel pixel) const {
    const double depth = image_[pixel];
    const double limit_per_pixel = options_.max_slope * image_.view().pixel_size(depth);
    int samples = 0;
    int nearer = 0;
    int compatible = 0;
    unsigned nearer_sectors = 0;
    for (const Neighbour& neighbour : window_) {
      const Pixel there{pixel.x + neighbour.dx, pixel.y + neighbour.dy};
      if (!image_.extent().contains(there)) continue;
      const double other = image_[there];
      if (other == kNoSample) continue;
      ++samples;
      const double limit = limit_per_pixel * neighbour.distance;
      if (other < depth - limit) {
        ++nearer;
        nearer_sectors |= neighbour.sector;
      } else if (neighbour.is_adjacent && other <= depth + limit) {
        ++compatible;
      }
    }
    const bool is_behind = 2 * nearer > samples && compatible < kMinCompatible;
    const bool is_surrounded = std::popcount(nearer_sectors) >= kMinSectors;
    const bool is_outlier = options_.remove_outliers && compatible < kOutlierCompatible &&
                            samples >= kOutlierNeighbours;
    return is_behind || is_surrounded || is_outlier;
  }

 private:
  const RangeImage& image_;
  const SeeThroughOptions& options_;
  std::array<Neighbour, 24> window_;
};

/// Decides on all samples by the image as it is, then removes; the number removed.
std::size_t remove_once(RangeImage& image, const SeeThroughOptions& options) {
  const SeeThroughRule rule(image, options);
  const Extent extent = image.extent();
  Grid<std::uint8_t> removed(extent, 0);
  for_each_row(extent.height, [&](int y) {
    for (Pixel p{0, y}; p.x < extent.width; ++p.x) {
      if (image.has_sample(p) && rule.removes(p)) removed[p] = 1;
    }
  });
  std::size_t count = 0;
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) {
      if (removed[{x, y}] == 0) continue;
      image[{x, y}] = kNoSample;
      ++count;
    }
  }
  return count;
}

}  // namespace

SeeThroughResult remove_see_through(RangeImage image, const SeeThroughOptions& options) {
  if (!(options.max_slope > 0.0)) {
    throw InvalidArgument("remove_see_through: max_slope must be positive, got " +
                          std::to_string(options.max_slope));
  }
  if (options.rounds < 0) {
    throw InvalidArgument("remove_see_through: rounds must not be negative, got " +
                          std::to_string(options.rounds));
  }
  SeeThroughResult result{.image = std::move(image)};
  for (int round = 0; round < options.rounds; ++round) {
    const std::size_t removed = remove_once(result.image, options);
    result.removed += removed;
    if (removed == 0) break;
  }
  return result;
}

}  // namespace rangezip
