#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/grid.h"
#include "core/raster/framebuffer.h"

namespace rangezip {

/// Depth and ID of a pixel in one number: the nearer fragment, and of equally near ones that with
/// the lower ID (R9), has the smaller key.
using PixelKey = std::uint64_t;
inline constexpr PixelKey kEmptyPixel = ~PixelKey{0};

/// Keys that a buffer holds after its last pixel, for vectors that reach past it.
inline constexpr std::size_t kKeyPadding = 16;

[[nodiscard]] constexpr PixelKey make_key(std::uint32_t depth, PrimitiveId id) noexcept {
  return PixelKey{depth} << 32U | id;
}

/// Where fragments go: each pixel keeps its smallest key.
struct DrawTarget {
  Extent extent;
  std::span<PixelKey> keys;         ///< extent.count() of them, and kKeyPadding behind the last
  const DepthBand* band = nullptr;  ///< where set, only depths inside of it count (R12)
};

/// Accepts every fragment.
struct AcceptAll {
  [[nodiscard]] bool operator()(std::size_t /*pixel*/, std::int32_t /*depth*/) const {
    return true;
  }
};

/// Accepts the fragments inside of a band.
struct AcceptInBand {
  std::span<const std::int32_t> lower;
  std::span<const std::int32_t> upper;

  explicit AcceptInBand(const DepthBand& band)
      : lower(band.lower.pixels()), upper(band.upper.pixels()) {}
  [[nodiscard]] bool operator()(std::size_t pixel, std::int32_t depth) const {
    return lower[pixel] <= depth && depth <= upper[pixel];
  }
};

/// Calls draw(accept) with what the target accepts, so that inner loops are compiled for each.
template <class Draw>
void with_acceptance(const DrawTarget& target, const Draw& draw) {
  if (target.band == nullptr) {
    draw(AcceptAll{});
  } else {
    draw(AcceptInBand(*target.band));
  }
}

/// Keeps the smaller key of every pixel in `onto`.
void merge_keys(std::span<PixelKey> onto, std::span<const PixelKey> from);

/// Splits a key. Where it is empty, all bits of it are set, and so are those of kNoDepth and
/// kNoPrimitive.
inline void unpack_key(PixelKey key, std::uint32_t& depth, PrimitiveId& id) noexcept {
  depth = static_cast<std::uint32_t>(key >> 32U);
  id = static_cast<PrimitiveId>(key);
}

/// Splits keys into depth and ID, from pixel `first` on.
void unpack_keys(std::span<const PixelKey> keys, std::size_t first, Framebuffer& out);

}  // namespace rangezip
