#pragma once

#include <cstdint>

#include "core/base/grid.h"
#include "core/raster/draw_item.h"

namespace rangezip {

/// Depth of a pixel where nothing was drawn; drawn depths lie in [0, kMaxDepth].
inline constexpr std::uint32_t kNoDepth = 0xffff'ffffU;
inline constexpr int kDepthBits = 24;
inline constexpr std::uint32_t kMaxDepth = (1U << kDepthBits) - 1U;

/// What a rasterizer leaves behind: the nearest surface in every pixel.
struct Framebuffer {
  Grid<std::uint32_t> depth;  ///< 24-bit fixed point from front to back plane, or kNoDepth
  Grid<PrimitiveId> id;       ///< kNoPrimitive where nothing was drawn

  friend bool operator==(const Framebuffer&, const Framebuffer&) = default;
};

/// An empty framebuffer.
[[nodiscard]] Framebuffer make_framebuffer(Extent extent);

/// Gives an image this extent, for a rasterizer that then sets every pixel: they are left as they
/// come, which spares emptying them.
void set_extent(Framebuffer& image, Extent extent);

/// Keeps in `onto`, per pixel, the nearer of the two; of equal depths the lower id. Order never
/// matters, so threads, chunks of a cloud too large for memory, and MPI ranks may each draw
/// their part and be put together by this.
/// @throws InvalidArgument if the extents differ.
void composite(Framebuffer& onto, const Framebuffer& from);

/// A depth interval per pixel, in units of 2^-24 of the depth range, both ends included; a pixel
/// with lower > upper takes nothing (R12).
struct DepthBand {
  Grid<std::int32_t> lower;
  Grid<std::int32_t> upper;
};

/// Sums over the points near one pixel centre (R13), all exact integers. With dx, dy the offset
/// of a point from the pixel centre in 1/256 px, w = (256 - |dx|)(256 - |dy|) the tent weight and
/// z the point's depth minus the pixel's reference, shifted right by the common shift:
struct PixelMoments {
  std::int64_t w = 0;
  std::int64_t w_dx = 0;
  std::int64_t w_dy = 0;
  std::int64_t w_dx_dx = 0;
  std::int64_t w_dx_dy = 0;
  std::int64_t w_dy_dy = 0;
  std::int64_t w_z = 0;
  std::int64_t w_z_dx = 0;
  std::int64_t w_z_dy = 0;
  std::int64_t w_vote = 0;

  friend bool operator==(const PixelMoments&, const PixelMoments&) = default;
};

/// What accumulate() sums over: the points whose depth lies in the band, measured from
/// `reference`.
struct AccumulateWindow {
  DepthBand band;
  Grid<std::int32_t> reference;  ///< depth units; the z of the sums is (Z - reference) >> shift
  int shift = 0;  ///< 0..8, one for the image, so that |Z - reference| >> shift < 2^20 in the band
};

}  // namespace rangezip
