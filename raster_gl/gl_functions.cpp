#include "raster_gl/gl_functions.h"

#include <string>

#include "core/base/error.h"

namespace rangezip {

namespace {

template <class Function>
Function load(const GlContext& context, const char* name) {
  const auto function = reinterpret_cast<Function>(context.function(name));
  if (function == nullptr) {
    throw BackendError("the OpenGL of context " + context.name() + " has no function " + name);
  }
  return function;
}

void check_version(const GlFunctions& gl, const GlContext& context) {
  GLint major = 0;
  GLint minor = 0;
  gl.GetIntegerv(GL_MAJOR_VERSION, &major);
  gl.GetIntegerv(GL_MINOR_VERSION, &minor);
  if (major > 4 || (major == 4 && minor >= 5)) return;
  throw BackendError("context " + context.name() + " must offer OpenGL 4.5, it has " +
                     std::to_string(major) + "." + std::to_string(minor));
}

}  // namespace

GlFunctions::GlFunctions(const CurrentContext& current) {
#define RANGEZIP_GL_LOAD(Type, name) name = load<Type>(current.context(), "gl" #name);
  RANGEZIP_GL_FUNCTIONS(RANGEZIP_GL_LOAD)
#undef RANGEZIP_GL_LOAD
  check_version(*this, current.context());
}

}  // namespace rangezip
