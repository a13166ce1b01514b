#include "raster_gl/read_back.h"

#include <algorithm>

#include "core/base/parallel.h"

namespace rangezip {

ReadBack::ReadBack(const GlFunctions& gl)
    : gl_(gl), staging_(make_object(gl.CreateBuffers, gl.DeleteBuffers)) {}

bool ReadBack::read(GLuint buffer, std::size_t offset, std::span<std::byte> bytes) {
  const auto size = static_cast<GLsizeiptr>(bytes.size());
  if (bytes.size() > capacity_) {
    gl_.NamedBufferData(staging_.name(), size, nullptr, GL_STREAM_READ);
    capacity_ = bytes.size();
  }
  gl_.CopyNamedBufferSubData(buffer, staging_.name(), static_cast<GLintptr>(offset), 0, size);
  const void* const mapped = gl_.MapNamedBufferRange(staging_.name(), 0, size, GL_MAP_READ_BIT);
  if (mapped == nullptr) {
    capacity_ = 0;  // it may have had no memory
    return false;
  }
  const auto* const from = static_cast<const std::byte*>(mapped);
  constexpr std::size_t kGrain = std::size_t{1} << 20;
  parallel_for(bytes.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    std::copy(from + begin, from + end, bytes.data() + begin);
  });
  return gl_.UnmapNamedBuffer(staging_.name()) == GL_TRUE;
}

}  // namespace rangezip
