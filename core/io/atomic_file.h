#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace rangezip {

/// A file that appears in full or not at all: written under another name beside the target and
/// renamed by commit(). Without commit(), by an exception or otherwise, nothing is left and the
/// target stays as it was. So an input may be overwritten while it is still being read.
///
/// A symbolic link is followed; an existing file passes on its permissions. A target that is no
/// regular file (a device, a pipe) is written directly.
class AtomicFile {
 public:
  /// @throws IoError if the target is a folder or the file cannot be made.
  explicit AtomicFile(const std::filesystem::path& target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// @throws IoError if the bytes cannot be stored (disk full, past the file-size limit).
  void write(std::string_view bytes);

  /// Makes the file appear under its name, flushed to the disk. Call it once, at the end.
  /// @throws IoError as write(), or if the file cannot be flushed or renamed.
  void commit();

 private:
  void flush_buffer();
  [[noreturn]] void fail(const std::string& action) const;

  std::filesystem::path target_;
  std::filesystem::path temporary_;  ///< empty: the target itself is written
  int descriptor_ = -1;
  std::string buffer_;
};

}  // namespace rangezip
