#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "core/base/progress.h"

namespace rangezip {

/// 64-bit FNV-1a [Fowler, Noll, Vo 1991]: tells whether an input is still the same file. Not
/// proof against anyone who wants two files to look alike. About 1 GB/s.
[[nodiscard]] std::uint64_t hash_bytes(std::string_view bytes);

/// hash_bytes() of a file as it lies on the disk; a .gz is not unpacked.
/// @throws IoError if the file is missing, a folder, unreadable or empty, or a pipe or device: to
///     hash what that gives would take it from whoever reads it next.
/// @throws Cancelled if `progress` says so.
[[nodiscard]] std::uint64_t hash_file(const std::filesystem::path& path,
                                      const Progress& progress = {});

}  // namespace rangezip
