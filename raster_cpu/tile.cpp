#include "raster_cpu/tile.h"

#include <algorithm>

namespace rangezip {

namespace {

/// A row of the image and its place in the tile.
struct TileRow {
  std::size_t in_image = 0;
  std::size_t in_tile = 0;
};

TileRow tile_row(const BandLayout& layout, PixelRange rows, int y) {
  return {layout.extent.index({0, y}), layout.in_tile(0, y - rows.first)};
}

}  // namespace

void Tile::load(const BandLayout& layout, int band, std::span<const PixelKey> image,
                const DepthBand* depths) {
  layout_ = layout;
  rows_ = layout.rows_of(band);
  is_banded_ = depths != nullptr;
  keys_.resize(layout.tile_pixels());
  PixelKey* at = keys_.data();
  if (!image.empty()) {
    for (int y = rows_.first; y <= rows_.last; ++y) {
      const TileRow row = tile_row(layout_, rows_, y);
      std::fill(at, &keys_[row.in_tile], kEmptyPixel);
      at = std::copy_n(&image[row.in_image], layout.extent.width, &keys_[row.in_tile]);
    }
  }
  std::fill(at, keys_.data() + keys_.size(), kEmptyPixel);
  if (is_banded_) load_depths(*depths);
}

void Tile::load_depths(const DepthBand& depths) {
  lower_.assign(layout_.tile_pixels(), 1);
  upper_.assign(layout_.tile_pixels(), 0);
  const auto width = static_cast<std::size_t>(layout_.extent.width);
  for (int y = rows_.first; y <= rows_.last; ++y) {
    const TileRow row = tile_row(layout_, rows_, y);
    std::copy_n(&depths.lower.pixels()[row.in_image], width, &lower_[row.in_tile]);
    std::copy_n(&depths.upper.pixels()[row.in_image], width, &upper_[row.in_tile]);
  }
}

void Tile::store(std::span<PixelKey> image) const {
  const auto width = static_cast<std::size_t>(layout_.extent.width);
  for (int y = rows_.first; y <= rows_.last; ++y) {
    const TileRow row = tile_row(layout_, rows_, y);
    std::copy_n(&keys_[row.in_tile], width, &image[row.in_image]);
  }
}

}  // namespace rangezip
