#include "raster_gl/read_back.h"

#include <cstring>

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
  std::memcpy(bytes.data(), mapped, bytes.size());
  return gl_.UnmapNamedBuffer(staging_.name()) == GL_TRUE;
}

}  // namespace rangezip
