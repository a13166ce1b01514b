#pragma once

#include <GL/glcorearb.h>

#include "raster_gl/gl_context.h"

namespace rangezip {

/// The OpenGL functions in use: X(type of the pointer, name without "gl").
#define RANGEZIP_GL_FUNCTIONS(X)                                         \
  X(PFNGLATTACHSHADERPROC, AttachShader)                                 \
  X(PFNGLBINDFRAMEBUFFERPROC, BindFramebuffer)                           \
  X(PFNGLBINDVERTEXARRAYPROC, BindVertexArray)                           \
  X(PFNGLCHECKNAMEDFRAMEBUFFERSTATUSPROC, CheckNamedFramebufferStatus)   \
  X(PFNGLCLEARNAMEDFRAMEBUFFERUIVPROC, ClearNamedFramebufferuiv)         \
  X(PFNGLCOMPILESHADERPROC, CompileShader)                               \
  X(PFNGLCREATEFRAMEBUFFERSPROC, CreateFramebuffers)                     \
  X(PFNGLCREATEPROGRAMPROC, CreateProgram)                               \
  X(PFNGLCREATERENDERBUFFERSPROC, CreateRenderbuffers)                   \
  X(PFNGLCREATESHADERPROC, CreateShader)                                 \
  X(PFNGLCREATEVERTEXARRAYSPROC, CreateVertexArrays)                     \
  X(PFNGLDELETEFRAMEBUFFERSPROC, DeleteFramebuffers)                     \
  X(PFNGLDELETEPROGRAMPROC, DeleteProgram)                               \
  X(PFNGLDELETERENDERBUFFERSPROC, DeleteRenderbuffers)                   \
  X(PFNGLDELETESHADERPROC, DeleteShader)                                 \
  X(PFNGLDELETEVERTEXARRAYSPROC, DeleteVertexArrays)                     \
  X(PFNGLDRAWARRAYSPROC, DrawArrays)                                     \
  X(PFNGLGETERRORPROC, GetError)                                         \
  X(PFNGLGETINTEGERVPROC, GetIntegerv)                                   \
  X(PFNGLGETPROGRAMINFOLOGPROC, GetProgramInfoLog)                       \
  X(PFNGLGETPROGRAMIVPROC, GetProgramiv)                                 \
  X(PFNGLGETSTRINGPROC, GetString)                                       \
  X(PFNGLLINKPROGRAMPROC, LinkProgram)                                   \
  X(PFNGLNAMEDFRAMEBUFFERRENDERBUFFERPROC, NamedFramebufferRenderbuffer) \
  X(PFNGLNAMEDRENDERBUFFERSTORAGEPROC, NamedRenderbufferStorage)         \
  X(PFNGLREADPIXELSPROC, ReadPixels)                                     \
  X(PFNGLSHADERSOURCEPROC, ShaderSource)                                 \
  X(PFNGLUSEPROGRAMPROC, UseProgram)                                     \
  X(PFNGLVIEWPORTPROC, Viewport)

/// Their addresses in one context: gl.DrawArrays(...).
struct GlFunctions {
  /// @throws BackendError if the context has no OpenGL 4.5 or lacks one of the functions.
  explicit GlFunctions(const CurrentContext& current);

#define RANGEZIP_GL_MEMBER(Type, name) Type name = nullptr;
  RANGEZIP_GL_FUNCTIONS(RANGEZIP_GL_MEMBER)
#undef RANGEZIP_GL_MEMBER
};

}  // namespace rangezip
