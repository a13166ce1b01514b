#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/progress.h"
#include "core/io/lazy_memory.h"

namespace rangezip {

/// The type of a file by its name: the last extension in lower case without the dot, and without a
/// final ".gz": "ply" for both "a.PLY" and "a.ply.gz"; empty if there is none.
[[nodiscard]] std::string file_type(const std::filesystem::path& path);

/// All bytes of a file for reading: mapped into memory, or unpacked in memory if the name ends in
/// ".gz". Also the voice of every complaint about that file. Files must not shrink while they
/// are read.
class FileBytes {
 public:
  enum class Packing { unpack, keep };  ///< what to do with a .gz

  /// @throws IoError if the file is missing, a folder, unreadable or empty, if a .gz is cut or
  ///     corrupt, or if a .gz or a pipe gives more than there is memory for (see lazy_memory.h).
  /// @throws Cancelled if `progress` says so, also while a pipe has nothing to read.
  explicit FileBytes(const std::filesystem::path& path, Packing packing = Packing::unpack,
                     const Progress& progress = {});
  ~FileBytes();
  FileBytes(const FileBytes&) = delete;
  FileBytes& operator=(const FileBytes&) = delete;

  /// Valid as long as this object.
  [[nodiscard]] std::string_view bytes() const noexcept { return bytes_; }
  /// The path as it was given.
  [[nodiscard]] const std::string& name() const noexcept { return name_; }

  /// Throws IoError "name: rule".
  [[noreturn]] void fail(const std::string& rule) const;
  /// Throws IoError "name: line N: rule"; N counts from 1 to the line that `place`, a position in
  /// bytes(), is on.
  [[noreturn]] void fail_at_line(const char* place, const std::string& rule) const;
  /// Throws IoError "name: byte N: rule"; N counts from 0, in the unpacked bytes.
  [[noreturn]] void fail_at_byte(const char* place, const std::string& rule) const;

 private:
  void map(int descriptor, std::size_t size);
  void read_stream(int descriptor, const Progress& progress);
  void unpack(const Progress& progress);
  [[noreturn]] void fail_for_memory(const char* gives, std::size_t bytes) const;

  std::string name_;
  LazyMemory owned_;     ///< unpacked bytes, or those of something that cannot be mapped
  void* map_ = nullptr;  ///< or the mapping
  std::size_t map_size_ = 0;
  std::string_view bytes_;
};

}  // namespace rangezip
