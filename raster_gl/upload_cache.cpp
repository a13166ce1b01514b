#include "raster_gl/upload_cache.h"

#include <algorithm>

namespace rangezip {

const GlBuffer& UploadCache::get_bytes(const UploadKey& key, std::span<const std::byte> bytes) {
  constexpr const char* kContent = "positions and corners";
  const auto found = std::find_if(entries_.begin(), entries_.end(),
                                  [&](const Entry& entry) { return entry.key == key; });
  if (key.content_key != 0 && found != entries_.end()) {
    entries_.splice(entries_.begin(), entries_, found);
    return entries_.front().buffer;
  }
  ++uploads_;
  if (key.content_key == 0 || bytes.size() > limit_) {
    passing_.upload(bytes, kContent);
    return passing_;
  }
  while (kept_bytes_ + bytes.size() > limit_) {
    kept_bytes_ -= entries_.back().bytes;
    entries_.pop_back();
  }
  GlBuffer buffer(device_);
  buffer.upload(bytes, kContent);
  entries_.push_front({key, bytes.size(), std::move(buffer)});
  kept_bytes_ += bytes.size();
  return entries_.front().buffer;
}

}  // namespace rangezip
