#pragma once

#include <memory>
#include <string>
#include <vector>

#include "raster_gl/gl_context.h"

namespace rangezip {

/// The context of a name: "osmesa"; "egl:N" for EGL's device N; "egl:surfaceless"; "egl" for the
/// first of EGL's devices, or the platform without surfaces where devices cannot be listed; "" for
/// the first of "egl" and "osmesa" that starts.
/// @throws BackendError if there is no such name (the text lists them), or the context does
///     not start
[[nodiscard]] std::unique_ptr<GlContext> make_gl_context(const std::string& name);

/// The names that make_gl_context() takes, as a text for users.
[[nodiscard]] std::string known_gl_contexts();

/// Every context that may start here by its name: one for each of EGL's devices, and the others.
[[nodiscard]] std::vector<std::string> list_gl_contexts();

}  // namespace rangezip
