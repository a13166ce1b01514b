#pragma once

#include <span>

#include "core/raster/framebuffer.h"
#include "raster_cpu/key_buffer.h"
#include "raster_cpu/simd_kernels.h"

namespace rangezip {

/// unpack_keys(), past the cache where the image is too large for it.
/// @param kernels null: scalar code
inline void unpack_into_image(std::span<const PixelKey> keys, std::size_t first,
                              const SimdKernels* kernels, Framebuffer& out) {
  constexpr std::size_t kLargePixels = std::size_t{1} << 21;
  if (kernels == nullptr || out.depth.extent().count() < kLargePixels) {
    unpack_keys(keys, first, out);
  } else {
    kernels->unpack_past_cache(keys, out.depth.pixels().data() + first,
                               out.id.pixels().data() + first);
  }
}

}  // namespace rangezip
