#include "raster_gl/gl_functions.h"

#include <string>

#include "core/base/error.h"

namespace rangezip {

namespace {

template <class Function>
void load(const GlContext& context, const char* name, Function& function) {
  function = reinterpret_cast<Function>(context.function(name));
  if (function != nullptr) return;
  throw BackendError("the OpenGL of context " + context.name() + " has no function " + name);
}

/// First of all: what an old OpenGL lacks is less telling than its version.
void check_version(const GlContext& context) {
  decltype(&::glGetIntegerv) get_integer = nullptr;
  load(context, "glGetIntegerv", get_integer);
  GLint major = 0;
  GLint minor = 0;
  get_integer(GL_MAJOR_VERSION, &major);
  get_integer(GL_MINOR_VERSION, &minor);
  if (major > 4 || (major == 4 && minor >= 5)) return;
  throw BackendError("context " + context.name() + " must offer OpenGL 4.5, it has " +
                     std::to_string(major) + "." + std::to_string(minor));
}

}  // namespace

GlFunctions::GlFunctions(const CurrentContext& current) {
  check_version(current.context());
  const auto find = [&](const char* name, auto& function) {
    load(current.context(), name, function);
  };
  RANGEZIP_GL_FUNCTIONS(RANGEZIP_FIND_FUNCTION)
}

}  // namespace rangezip
