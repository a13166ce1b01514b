#pragma once

#include <filesystem>
#include <iosfwd>

namespace rangezip::compare {

struct ImagesCommand {
  std::filesystem::path reference;
  std::filesystem::path candidate;
};

/// Compares two image files that `rangezip scan` wrote (depths or range images as PFM, IDs or masks
/// as PNG), prints how they differ to `out`.
/// @return true if they are identical
/// @throws IoError if a file cannot be read, is none of these kinds, or the two are of different
///     kinds or extents.
bool run_images_command(const ImagesCommand& command, std::ostream& out);

}  // namespace rangezip::compare
