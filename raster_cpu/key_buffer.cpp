#include "raster_cpu/key_buffer.h"

#include <algorithm>

namespace rangezip {

void merge_keys(std::span<PixelKey> onto, std::span<const PixelKey> from) {
  for (std::size_t i = 0; i < onto.size(); ++i)
    onto[i] = std::min(onto[i], from[i]);
}

void unpack_keys(std::span<const PixelKey> keys, Extent extent, Framebuffer& out) {
  if (out.depth.extent() != extent) out.depth.reset(extent);
  if (out.id.extent() != extent) out.id.reset(extent);
  const auto depth = out.depth.pixels();
  const auto id = out.id.pixels();
  // An empty key is all ones, and so are kNoDepth and kNoPrimitive.
  for (std::size_t i = 0; i < keys.size(); ++i) {
    depth[i] = static_cast<std::uint32_t>(keys[i] >> 32U);
    id[i] = static_cast<PrimitiveId>(keys[i]);
  }
}

}  // namespace rangezip
