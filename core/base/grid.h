#pragma once

#include <cassert>
#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace rangezip {

/// A pixel index: x to the right, y UP, (0, 0) the lower left one, as in OpenGL. The centre of
/// pixel (x, y) lies at (x + 0.5, y + 0.5) in window coordinates. Only image files are stored
/// upside down, by their writers.
struct Pixel {
  int x = 0;
  int y = 0;

  friend auto operator<=>(const Pixel&, const Pixel&) = default;
};

/// Width and height of an image, in pixels.
struct Extent {
  int width = 0;
  int height = 0;

  [[nodiscard]] constexpr bool contains(Pixel p) const noexcept {
    return p.x >= 0 && p.x < width && p.y >= 0 && p.y < height;
  }
  [[nodiscard]] constexpr std::size_t count() const noexcept {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  /// Position of a pixel in row-major order, bottom row first. @pre contains(p)
  [[nodiscard]] constexpr std::size_t index(Pixel p) const noexcept {
    return static_cast<std::size_t>(p.y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(p.x);
  }
  friend bool operator==(const Extent&, const Extent&) = default;
};

/// What a grid may hold: plain data that can be copied to a device or a file.
/// bool is left out, since its packed vector has no span; use std::uint8_t.
template <class T>
concept PixelValue =
    std::is_trivially_copyable_v<T> && std::equality_comparable<T> && !std::same_as<T, bool>;

/// A dense image of T, row after row from the bottom. Owns its pixels, is copied by value,
/// compares bit for bit.
template <PixelValue T>
class Grid {
 public:
  Grid() = default;
  explicit Grid(Extent extent, T fill = T{}) : extent_(extent), pixels_(extent.count(), fill) {}

  [[nodiscard]] Extent extent() const noexcept { return extent_; }

  [[nodiscard]] T& operator[](Pixel p) { return pixels_[index(p)]; }
  [[nodiscard]] const T& operator[](Pixel p) const { return pixels_[index(p)]; }

  /// Row y, left to right.
  [[nodiscard]] std::span<T> row(int y) { return pixels().subspan(index({0, y}), width()); }
  [[nodiscard]] std::span<const T> row(int y) const {
    return pixels().subspan(index({0, y}), width());
  }

  /// All pixels, bottom row first.
  [[nodiscard]] std::span<T> pixels() noexcept { return pixels_; }
  [[nodiscard]] std::span<const T> pixels() const noexcept { return pixels_; }

  /// Gives the grid this extent and every pixel this value, keeping the memory where it can.
  void reset(Extent extent, T fill = T{}) {
    extent_ = extent;
    pixels_.assign(extent.count(), fill);
  }

  friend bool operator==(const Grid&, const Grid&) = default;

 private:
  [[nodiscard]] std::size_t width() const { return static_cast<std::size_t>(extent_.width); }
  [[nodiscard]] std::size_t index(Pixel p) const {
    assert(extent_.contains(p));
    return extent_.index(p);
  }

  Extent extent_;
  std::vector<T> pixels_;
};

/// Which pixels take part: 1 active, 0 not. One byte a pixel, so that it is a span, a NumPy array
/// and a GL upload as it is.
using Mask = Grid<std::uint8_t>;

}  // namespace rangezip
