#pragma once

#include <cstdint>
#include <string>

#include "core/base/grid.h"
#include "raster_gl/gl_context.h"

namespace rangezip {

/// What a context says of itself, and a triangle that it has drawn.
struct GlProbe {
  std::string version;   ///< "4.5 (Core Profile) Mesa 22.3.6"
  std::string renderer;  ///< "llvmpipe (LLVM 15.0.6, 256 bits)"
  /// 16 x 16 pixels of 32-bit integers: kProbeValue inside of the triangle with the corners
  /// (2, 2), (14.5, 2), (2, 14.5) in pixels, 0 outside. No pixel centre lies on its edges.
  Grid<std::uint32_t> image;
};

/// A number that needs all 32 bits.
inline constexpr std::uint32_t kProbeValue = 0x8765'4321U;

/// Draws one triangle into an integer framebuffer object and reads it back: shows that a context
/// works before anything relies on it.
/// @throws BackendError if the context cannot be made current, offers less than OpenGL 4.5, or
///     reports an error.
[[nodiscard]] GlProbe probe(GlContext& context);

}  // namespace rangezip
