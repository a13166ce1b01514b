#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "raster_gl/gl_device.h"
#include "raster_gl/gl_objects.h"

namespace rangezip {

/// Memory of the device. Kept as long as the object lives, reused where it is large enough.
class GlBuffer {
 public:
  /// A buffer has a multiple of so many bytes: shaders see whole words, and groups of four.
  static constexpr std::size_t kGranule = 16;

  explicit GlBuffer(const GlDevice& device);

  [[nodiscard]] GLuint name() const noexcept { return object_.name(); }
  [[nodiscard]] std::size_t capacity() const noexcept { return bytes_; }

  /// Makes room for `bytes`, at least. What was inside is lost if there was not enough.
  /// @param content for the text of the error: "the positions"
  /// @throws BackendError if the device has no memory for it
  void reserve(std::size_t bytes, const char* content);

  /// Puts `values` at the beginning. @throws BackendError as reserve()
  template <class T, std::size_t kExtent>
  void upload(std::span<const T, kExtent> values, const char* content) {
    upload_bytes(std::as_bytes(values), content);
  }

  /// Copies from `offset` bytes on into `values`. Waits for the device.
  template <class T, std::size_t kExtent>
  void download(std::span<T, kExtent> values, std::size_t offset = 0) const {
    download_bytes(std::as_writable_bytes(values), offset);
  }

 private:
  void upload_bytes(std::span<const std::byte> bytes, const char* content);
  void download_bytes(std::span<std::byte> bytes, std::size_t offset) const;

  const GlDevice* device_;
  GlObject object_;
  std::size_t bytes_ = 0;
};

}  // namespace rangezip
