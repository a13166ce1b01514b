#pragma once

#include <cstddef>
#include <cstdint>

#include "core/raster/framebuffer.h"
#include "raster_cpu/point_bins.h"

namespace rangezip {

/// A point in a band: the place of its lower left pixel in the tile, its depth, and its number in
/// the run that it belongs to, from the highest bit down.
using Fragment = BinEntry;
inline constexpr int kRunBits = 22;
/// Points that a run may have.
inline constexpr std::size_t kMaxRun = std::size_t{1} << kRunBits;
/// Pixels that a tile may have.
inline constexpr std::size_t kMaxTilePixels = std::size_t{1} << (64 - kRunBits - kDepthBits);

[[nodiscard]] constexpr std::size_t tile_pixel(Fragment f) noexcept {
  return f >> (kRunBits + kDepthBits);
}
[[nodiscard]] constexpr std::uint32_t depth_of(Fragment f) noexcept {
  return static_cast<std::uint32_t>(f >> kRunBits) & ((1U << kDepthBits) - 1U);
}
[[nodiscard]] constexpr std::uint32_t number_in_run(Fragment f) noexcept {
  return static_cast<std::uint32_t>(f) & ((1U << kRunBits) - 1U);
}

}  // namespace rangezip
