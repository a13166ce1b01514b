#include "raster_cpu/key_buffer.h"

#include <algorithm>

namespace rangezip {

void merge_keys(std::span<PixelKey> onto, std::span<const PixelKey> from) {
  for (std::size_t i = 0; i < onto.size(); ++i)
    onto[i] = std::min(onto[i], from[i]);
}

void unpack_keys(std::span<const PixelKey> keys, std::size_t first, Framebuffer& out) {
  const auto depth = out.depth.pixels().subspan(first, keys.size());
  const auto id = out.id.pixels().subspan(first, keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i)
    unpack_key(keys[i], depth[i], id[i]);
}

}  // namespace rangezip
