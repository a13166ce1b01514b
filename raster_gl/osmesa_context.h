#pragma once

#include <memory>
#include <string>

#include "raster_gl/gl_context.h"

namespace rangezip {

/// An OpenGL 4.5 core context of Mesa's software renderer: needs no display and no GPU. The library
/// is opened at run time, so that programs start where it is missing. It runs threads of its own;
/// the environment variable LP_NUM_THREADS limits them.
/// @throws BackendError if the library cannot be opened, is not OSMesa, or offers less than 4.5.
[[nodiscard]] std::unique_ptr<GlContext> make_osmesa_context(
    const std::string& library = "libOSMesa.so.8");

}  // namespace rangezip
