#pragma once

#include <GL/glcorearb.h>

#include "raster_gl/gl_context.h"

namespace rangezip {

/// The OpenGL functions in use: X(type of the pointer, name without "gl").
#define RANGEZIP_GL_FUNCTIONS(X)                                         \
  X(PFNGLATTACHSHADERPROC, AttachShader)                                 \
  X(PFNGLBINDBUFFERBASEPROC, BindBufferBase)                             \
  X(PFNGLBINDFRAMEBUFFERPROC, BindFramebuffer)                           \
  X(PFNGLBINDVERTEXARRAYPROC, BindVertexArray)                           \
  X(PFNGLCHECKNAMEDFRAMEBUFFERSTATUSPROC, CheckNamedFramebufferStatus)   \
  X(PFNGLCLEARNAMEDBUFFERSUBDATAPROC, ClearNamedBufferSubData)           \
  X(PFNGLCLEARNAMEDFRAMEBUFFERFVPROC, ClearNamedFramebufferfv)           \
  X(PFNGLCLEARNAMEDFRAMEBUFFERUIVPROC, ClearNamedFramebufferuiv)         \
  X(PFNGLCLIPCONTROLPROC, ClipControl)                                   \
  X(PFNGLCOMPILESHADERPROC, CompileShader)                               \
  X(PFNGLCREATEBUFFERSPROC, CreateBuffers)                               \
  X(PFNGLCREATEFRAMEBUFFERSPROC, CreateFramebuffers)                     \
  X(PFNGLCREATEPROGRAMPROC, CreateProgram)                               \
  X(PFNGLCREATERENDERBUFFERSPROC, CreateRenderbuffers)                   \
  X(PFNGLCREATESHADERPROC, CreateShader)                                 \
  X(PFNGLCREATEVERTEXARRAYSPROC, CreateVertexArrays)                     \
  X(PFNGLCULLFACEPROC, CullFace)                                         \
  X(PFNGLDEBUGMESSAGECALLBACKPROC, DebugMessageCallback)                 \
  X(PFNGLDELETEBUFFERSPROC, DeleteBuffers)                               \
  X(PFNGLDELETEFRAMEBUFFERSPROC, DeleteFramebuffers)                     \
  X(PFNGLDELETEPROGRAMPROC, DeleteProgram)                               \
  X(PFNGLDELETERENDERBUFFERSPROC, DeleteRenderbuffers)                   \
  X(PFNGLDELETESHADERPROC, DeleteShader)                                 \
  X(PFNGLDELETEVERTEXARRAYSPROC, DeleteVertexArrays)                     \
  X(PFNGLDEPTHFUNCPROC, DepthFunc)                                       \
  X(PFNGLDISABLEPROC, Disable)                                           \
  X(PFNGLDISPATCHCOMPUTEPROC, DispatchCompute)                           \
  X(PFNGLDRAWARRAYSPROC, DrawArrays)                                     \
  X(PFNGLDRAWELEMENTSPROC, DrawElements)                                 \
  X(PFNGLENABLEPROC, Enable)                                             \
  X(PFNGLFINISHPROC, Finish)                                             \
  X(PFNGLFRONTFACEPROC, FrontFace)                                       \
  X(PFNGLGETERRORPROC, GetError)                                         \
  X(PFNGLGETFLOATVPROC, GetFloatv)                                       \
  X(PFNGLGETGRAPHICSRESETSTATUSPROC, GetGraphicsResetStatus)             \
  X(PFNGLGETINTEGER64VPROC, GetInteger64v)                               \
  X(PFNGLGETINTEGERVPROC, GetIntegerv)                                   \
  X(PFNGLGETNAMEDBUFFERSUBDATAPROC, GetNamedBufferSubData)               \
  X(PFNGLGETPROGRAMINFOLOGPROC, GetProgramInfoLog)                       \
  X(PFNGLGETPROGRAMIVPROC, GetProgramiv)                                 \
  X(PFNGLGETSHADERINFOLOGPROC, GetShaderInfoLog)                         \
  X(PFNGLGETSHADERIVPROC, GetShaderiv)                                   \
  X(PFNGLGETSTRINGPROC, GetString)                                       \
  X(PFNGLGETSTRINGIPROC, GetStringi)                                     \
  X(PFNGLGETUNIFORMLOCATIONPROC, GetUniformLocation)                     \
  X(PFNGLLINKPROGRAMPROC, LinkProgram)                                   \
  X(PFNGLMEMORYBARRIERPROC, MemoryBarrier)                               \
  X(PFNGLNAMEDBUFFERDATAPROC, NamedBufferData)                           \
  X(PFNGLNAMEDBUFFERSUBDATAPROC, NamedBufferSubData)                     \
  X(PFNGLNAMEDFRAMEBUFFERRENDERBUFFERPROC, NamedFramebufferRenderbuffer) \
  X(PFNGLNAMEDRENDERBUFFERSTORAGEPROC, NamedRenderbufferStorage)         \
  X(PFNGLPROGRAMUNIFORM1IPROC, ProgramUniform1i)                         \
  X(PFNGLPROGRAMUNIFORM1UIPROC, ProgramUniform1ui)                       \
  X(PFNGLPROGRAMUNIFORMMATRIX4FVPROC, ProgramUniformMatrix4fv)           \
  X(PFNGLREADPIXELSPROC, ReadPixels)                                     \
  X(PFNGLSHADERSOURCEPROC, ShaderSource)                                 \
  X(PFNGLUSEPROGRAMPROC, UseProgram)                                     \
  X(PFNGLVERTEXARRAYELEMENTBUFFERPROC, VertexArrayElementBuffer)         \
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
