#pragma once

#include <memory>
#include <string>

#include "raster_gl/gl_context.h"

namespace rangezip {

/// An OpenGL 4.5 core context of EGL's device `index`: a GPU without a display, or Mesa's software
/// renderer. The library is opened at run time, so that programs start where it is missing.
/// @throws BackendError if the library cannot be opened or lacks what is needed, if there is no
///     such device, or if it offers less than OpenGL 4.5.
[[nodiscard]] std::unique_ptr<GlContext> make_egl_device_context(
    int index, const std::string& library = "libEGL.so.1");

/// The same on Mesa's platform without surfaces, which picks the device itself.
/// @throws BackendError as above
[[nodiscard]] std::unique_ptr<GlContext> make_egl_surfaceless_context(
    const std::string& library = "libEGL.so.1");

/// Number of EGL devices here. @throws BackendError if the library cannot be opened or cannot list
///     devices
[[nodiscard]] int count_egl_devices(const std::string& library = "libEGL.so.1");

}  // namespace rangezip
