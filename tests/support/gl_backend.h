#pragma once

#include <memory>
#include <string>

#include "core/raster/rasterizer.h"

namespace rangezip {

/// A rasterizer that passes on to one GlRasterizer a process: it compiles its shaders once, and
/// nothing of one drawing may show in the next.
/// @throws BackendError if it cannot start: then tests fail
[[nodiscard]] std::unique_ptr<Rasterizer> make_shared_gl(const std::string& name);

}  // namespace rangezip
