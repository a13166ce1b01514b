#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/raster/framebuffer.h"
#include "raster_cpu/band_layout.h"
#include "raster_cpu/key_buffer.h"

namespace rangezip {

/// The pixels of one band of rows and of the margin around them, while they are drawn.
class Tile {
 public:
  /// Empties the tile for band `band` of an image, or fills it with what `image` holds, where that
  /// is not empty. @param depths if set, the depths that count (R12)
  void load(const BandLayout& layout, int band, std::span<const PixelKey> image,
            const DepthBand* depths);

  /// The band's part of the image becomes what the tile holds.
  void store(std::span<PixelKey> image) const;
  /// Calls unpack(keys, first pixel) for each row of the band.
  template <class Unpack>
  void unpack(const Unpack& unpack) const {
    for (int y = rows_.first; y <= rows_.last; ++y) {
      unpack(std::span(keys_).subspan(layout_.in_tile(0, y - rows_.first),
                                      static_cast<std::size_t>(layout_.extent.width)),
             layout_.extent.index({0, y}));
    }
  }

  [[nodiscard]] PixelKey* keys() { return keys_.data(); }
  [[nodiscard]] std::size_t stride() const { return static_cast<std::size_t>(layout_.stride()); }

  /// Least and largest depth that counts, per pixel of the tile; none in the margin.
  struct Depths {
    const std::int32_t* lower = nullptr;  ///< null: all count
    const std::int32_t* upper = nullptr;
  };
  [[nodiscard]] Depths depths() const {
    return is_banded_ ? Depths{lower_.data(), upper_.data()} : Depths{};
  }

 private:
  void load_depths(const DepthBand& depths);

  BandLayout layout_;
  PixelRange rows_;
  bool is_banded_ = false;
  std::vector<PixelKey> keys_;
  std::vector<std::int32_t> lower_;
  std::vector<std::int32_t> upper_;
};

}  // namespace rangezip
