#include "core/io/file_hash.h"

#include "core/base/error.h"
#include "core/io/file_bytes.h"

namespace rangezip {

std::uint64_t hash_bytes(std::string_view bytes) {
  constexpr std::uint64_t kOffsetBasis = 0xcbf2'9ce4'8422'2325U;
  constexpr std::uint64_t kPrime = 0x0000'0100'0000'01b3U;
  std::uint64_t hash = kOffsetBasis;
  for (const char c : bytes)
    hash = (hash ^ static_cast<unsigned char>(c)) * kPrime;
  return hash;
}

std::uint64_t hash_file(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_other(path, error)) {
    throw IoError(path.string() + ": a pipe or device has no content that can be read again");
  }
  return hash_bytes(FileBytes(path, FileBytes::Packing::keep).bytes());
}

}  // namespace rangezip
