#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "core/base/grid.h"

namespace rangezip {

/// Rows [first_row, first_row + row_count) of an image, which is drawn in such parts where
/// the driver does not let shaders see a buffer for all of its pixels.
struct ImagePart {
  Extent extent;  ///< of the whole image
  int first_row = 0;
  int row_count = 0;

  [[nodiscard]] std::size_t pixels() const noexcept {
    return static_cast<std::size_t>(extent.width) * static_cast<std::size_t>(row_count);
  }

  /// The part of a whole image's pixels.
  template <class T>
  [[nodiscard]] std::span<T> of(std::span<T> image) const {
    return image.subspan(extent.index({0, first_row}), pixels());
  }
};

/// Parts of at most `most_pixels` pixels, but at least a row, from the lowest on.
[[nodiscard]] inline std::vector<ImagePart> parts_of(Extent extent, std::size_t most_pixels) {
  const auto width = static_cast<std::size_t>(extent.width);
  const auto rows = static_cast<int>(
      std::clamp<std::size_t>(most_pixels / width, 1, static_cast<std::size_t>(extent.height)));
  std::vector<ImagePart> parts;
  for (int first = 0; first < extent.height; first += rows) {
    parts.push_back(
        {.extent = extent, .first_row = first, .row_count = std::min(rows, extent.height - first)});
  }
  return parts;
}

}  // namespace rangezip
