#pragma once

#include <memory>
#include <string>

#include "core/raster/rasterizer.h"

namespace rangezip::app {

/// The names that make_rasterizer() takes, separated by commas.
[[nodiscard]] std::string known_backends();

/// @throws BackendError if there is no such backend (the text lists the known ones), or if it
///     cannot start.
[[nodiscard]] std::unique_ptr<Rasterizer> make_rasterizer(const std::string& name);

}  // namespace rangezip::app
