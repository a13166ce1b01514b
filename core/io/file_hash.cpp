#include "core/io/file_hash.h"

#include "core/base/error.h"
#include "core/io/file_bytes.h"

namespace rangezip {

namespace {

constexpr std::uint64_t kOffsetBasis = 0xcbf2'9ce4'8422'2325U;
constexpr std::size_t kBlock = std::size_t{1}
                               << 24U;  ///< bytes between two looks at the stop token

/// The hash of what `hash` is of, and the bytes behind it.
std::uint64_t continue_hash(std::uint64_t hash, std::string_view bytes) {
  constexpr std::uint64_t kPrime = 0x0000'0100'0000'01b3U;
  for (const char c : bytes)
    hash = (hash ^ static_cast<unsigned char>(c)) * kPrime;
  return hash;
}

}  // namespace

std::uint64_t hash_bytes(std::string_view bytes) {
  return continue_hash(kOffsetBasis, bytes);
}

std::uint64_t hash_file(const std::filesystem::path& path, const Progress& progress) {
  std::error_code error;
  if (std::filesystem::is_other(path, error)) {
    throw IoError(path.string() + ": a pipe or device has no content that can be read again");
  }
  const FileBytes file(path, FileBytes::Packing::keep, progress);
  std::uint64_t hash = kOffsetBasis;
  for (std::size_t at = 0; at < file.bytes().size(); at += kBlock) {
    progress.check_stop();
    hash = continue_hash(hash, file.bytes().substr(at, kBlock));
  }
  return hash;
}

}  // namespace rangezip
