#pragma once

#include <memory>
#include <string>

#include "core/raster/rasterizer.h"

namespace rangezip {

/// A rasterizer that passes on to one GlRasterizer a process: it compiles its shaders once, and
/// nothing of one drawing may show in the next.
/// @param name a context and perhaps a strategy: "osmesa", "egl:0 fixed_function"; with the word
///     "one_pass" the driver must do with one pass a drawing (64-bit atomics)
/// @throws BackendError if it cannot start: then tests fail
[[nodiscard]] std::unique_ptr<Rasterizer> make_shared_gl(const std::string& name);

}  // namespace rangezip
