#pragma once

#include <algorithm>
#include <cstdint>

namespace rangezip {

/// Window coordinates of the rasterizer are integers in 1/256 pixel; the centre of pixel i lies at
/// 256 i + 128.
inline constexpr int kSubpixelBits = 8;
inline constexpr std::int32_t kSubpixels = 1 << kSubpixelBits;
inline constexpr std::int32_t kHalfPixel = kSubpixels / 2;

/// Coordinate of the centre of pixel i.
[[nodiscard]] constexpr std::int32_t pixel_center(int i) noexcept {
  return i * kSubpixels + kHalfPixel;
}

/// Pixels first..last along one axis; empty if first > last.
struct PixelRange {
  int first = 0;
  int last = -1;

  [[nodiscard]] constexpr bool is_empty() const noexcept { return first > last; }
  [[nodiscard]] constexpr int count() const noexcept { return last - first + 1; }
};

/// The pixels of an image `size` wide that lie in first..last.
[[nodiscard]] constexpr PixelRange on_screen(PixelRange range, int size) noexcept {
  return {std::max(range.first, 0), std::min(range.last, size - 1)};
}

/// The pixels whose centres lie in [lower, upper].
[[nodiscard]] constexpr PixelRange centers_between(std::int32_t lower,
                                                   std::int32_t upper) noexcept {
  // The shift rounds down; the addend makes it round up.
  return {(lower - kHalfPixel + kSubpixels - 1) >> kSubpixelBits,
          (upper - kHalfPixel) >> kSubpixelBits};
}

/// R5: the pixels that a point of size `size` covers along one axis.
[[nodiscard]] constexpr PixelRange covered_by_point(std::int32_t center, int size) noexcept {
  const int first = (center - kHalfPixel * (size - 1)) >> kSubpixelBits;
  return {first, first + size - 1};
}

}  // namespace rangezip
