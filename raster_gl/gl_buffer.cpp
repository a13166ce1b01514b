#include "raster_gl/gl_buffer.h"

#include <algorithm>
#include <string>

namespace rangezip {

GlBuffer::GlBuffer(const GlDevice& device)
    : device_(&device),
      object_(make_object(device.gl().CreateBuffers, device.gl().DeleteBuffers)) {}

void GlBuffer::reserve(std::size_t bytes, const char* content) {
  constexpr std::size_t kLeast = 64;  // a buffer without memory cannot be bound
  bytes = std::max((bytes + kGranule - 1) / kGranule * kGranule, kLeast);
  if (bytes <= bytes_) return;
  bytes_ = 0;
  device_->gl().NamedBufferData(name(), static_cast<GLsizeiptr>(bytes), nullptr, GL_DYNAMIC_COPY);
  device_->check((std::to_string(bytes) + " bytes for " + content).c_str());
  bytes_ = bytes;
}

void GlBuffer::upload_bytes(std::span<const std::byte> bytes, const char* content) {
  const PhaseScope phase(*device_, GlPhase::upload);
  reserve(bytes.size(), content);
  if (bytes.empty()) return;
  device_->gl().NamedBufferSubData(name(), 0, static_cast<GLsizeiptr>(bytes.size()), bytes.data());
  device_->check(content);
}

void GlBuffer::download_bytes(std::span<std::byte> bytes, std::size_t offset) const {
  if (bytes.empty()) return;
  const PhaseScope phase(*device_, GlPhase::read);
  device_->read(name(), offset, bytes);
}

}  // namespace rangezip
