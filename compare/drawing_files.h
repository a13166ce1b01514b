#pragma once

#include <filesystem>

#include "core/raster/framebuffer.h"

namespace rangezip::compare {

/// A drawing that another program made, or `rangezip scan --depth --ids`.
/// @param depth PFM of window depths: 0 at the front plane, 1 at the back; they are rounded to the
///     nearest of the 2^24 units. Where no ID is, infinity or at least 1 (a cleared buffer) is
///     nothing.
/// @param ids PNG as write_id_png() writes it
/// @throws IoError naming file, pixel and rule: unreadable, of two extents, or a depth that is NaN
///     or outside of [0, 1] where an ID is.
[[nodiscard]] Framebuffer read_drawing(const std::filesystem::path& depth,
                                       const std::filesystem::path& ids);

}  // namespace rangezip::compare
