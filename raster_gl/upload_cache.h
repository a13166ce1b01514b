#pragma once

#include <cstdint>
#include <list>
#include <span>

#include "raster_gl/gl_buffer.h"

namespace rangezip {

/// Which part of an item's content a buffer holds.
struct UploadKey {
  std::uint64_t content_key = 0;  ///< of the item; 0: not to be kept
  bool is_corners = false;        ///< of triangles; else positions
  std::size_t first = 0;
  std::size_t count = 0;

  friend bool operator==(const UploadKey&, const UploadKey&) = default;
};

/// Uploads of content that is drawn again and again, up to a limit in bytes; those not used
/// for the longest time go first. What has no content key is kept until the next upload only.
class UploadCache {
 public:
  /// @param limit bytes that are kept for content with a key
  UploadCache(const GlDevice& device, std::size_t limit)
      : device_(device), limit_(limit), passing_(device) {}

  /// A buffer that holds `values`, until the next call. @throws BackendError without memory
  template <class T>
  [[nodiscard]] const GlBuffer& get(const UploadKey& key, std::span<const T> values) {
    return get_bytes(key, std::as_bytes(values));
  }

  /// Uploads so far, for tests.
  [[nodiscard]] std::size_t uploads() const noexcept { return uploads_; }

 private:
  struct Entry {
    UploadKey key;
    std::size_t bytes = 0;
    GlBuffer buffer;
  };

  const GlBuffer& get_bytes(const UploadKey& key, std::span<const std::byte> bytes);

  const GlDevice& device_;
  std::size_t limit_;
  std::size_t kept_bytes_ = 0;
  std::size_t uploads_ = 0;
  std::list<Entry> entries_;  ///< the last used first
  GlBuffer passing_;          ///< of what is not kept
};

}  // namespace rangezip
