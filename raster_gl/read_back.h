#pragma once

#include <cstddef>
#include <span>

#include "raster_gl/gl_functions.h"
#include "raster_gl/gl_objects.h"

namespace rangezip {

/// What buffers of the device are read through: the driver copies into memory of the host that it
/// reaches itself. To ask for a buffer's content directly makes NVIDIA's driver move the whole
/// buffer to the host, and back with the next drawing. One for all buffers of a context; used while
/// it is current.
class ReadBack {
 public:
  explicit ReadBack(const GlFunctions& gl);

  /// Copies from `offset` bytes of `buffer` on into `bytes`. Waits for the device. Cost: the bytes,
  /// twice; keeps as much memory as the largest read.
  /// @return whether it has; if not, glGetError() tells why
  [[nodiscard]] bool read(GLuint buffer, std::size_t offset, std::span<std::byte> bytes);

 private:
  const GlFunctions& gl_;
  GlObject staging_;
  std::size_t capacity_ = 0;
};

}  // namespace rangezip
