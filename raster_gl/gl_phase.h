#pragma once

#include <cstdint>
#include <functional>

namespace rangezip {

/// What OpenGL does in a call of GlRasterizer. What the call does before its first phase is the
/// host's own work: emptying the caller's image.
enum class GlPhase : std::uint8_t {
  upload,  ///< bytes go to the device: positions, corners, bands, and the small numbers of kernels
  draw,    ///< kernels and fixed functions, and the host between them
  read,    ///< bytes come back: images, sums, counters
};

/// Told where a phase begins, after the device has finished the one before. Must not throw.
using GlPhaseObserver = std::function<void(GlPhase)>;

}  // namespace rangezip
