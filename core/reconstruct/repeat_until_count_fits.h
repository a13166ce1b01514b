#pragma once

#include <cstddef>
#include <functional>

#include "core/base/progress.h"
#include "core/reconstruct/reconstruct.h"

namespace rangezip {

/// A run for pixels of an excess: see choose_resolution() in core/reconstruct/resolution.h.
using RunForExcess = std::function<ReconstructResult(double excess, const Progress&)>;

/// How many triangles a mesh of pixels has depends on how the surface lies to the views that win,
/// and is known only afterwards: while it is more than 2.5 % off, it is tried again with other
/// pixels, eight times at most. @return the nearest of what was tried, with the stages of all
/// @param triangles wanted, positive
[[nodiscard]] ReconstructResult repeat_until_count_fits(const RunForExcess& run,
                                                        std::size_t triangles,
                                                        const Progress& progress);

}  // namespace rangezip
