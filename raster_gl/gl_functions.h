#pragma once

// Declarations too, for the types of the functions.
#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>

#include "raster_gl/function_table.h"
#include "raster_gl/gl_context.h"

namespace rangezip {

/// The OpenGL functions in use.
#define RANGEZIP_GL_FUNCTIONS(X)      \
  X(gl, AttachShader)                 \
  X(gl, BindBufferBase)               \
  X(gl, BindFramebuffer)              \
  X(gl, BindVertexArray)              \
  X(gl, CheckNamedFramebufferStatus)  \
  X(gl, ClearNamedFramebufferfv)      \
  X(gl, ClearNamedFramebufferuiv)     \
  X(gl, ClipControl)                  \
  X(gl, CompileShader)                \
  X(gl, CopyNamedBufferSubData)       \
  X(gl, CreateBuffers)                \
  X(gl, CreateFramebuffers)           \
  X(gl, CreateProgram)                \
  X(gl, CreateRenderbuffers)          \
  X(gl, CreateShader)                 \
  X(gl, CreateVertexArrays)           \
  X(gl, CullFace)                     \
  X(gl, DebugMessageCallback)         \
  X(gl, DeleteBuffers)                \
  X(gl, DeleteFramebuffers)           \
  X(gl, DeleteProgram)                \
  X(gl, DeleteRenderbuffers)          \
  X(gl, DeleteShader)                 \
  X(gl, DeleteVertexArrays)           \
  X(gl, DepthFunc)                    \
  X(gl, Disable)                      \
  X(gl, DispatchCompute)              \
  X(gl, DrawArrays)                   \
  X(gl, DrawElements)                 \
  X(gl, Enable)                       \
  X(gl, Finish)                       \
  X(gl, FrontFace)                    \
  X(gl, GetError)                     \
  X(gl, GetFloatv)                    \
  X(gl, GetGraphicsResetStatus)       \
  X(gl, GetInteger64v)                \
  X(gl, GetIntegerv)                  \
  X(gl, GetProgramInfoLog)            \
  X(gl, GetProgramiv)                 \
  X(gl, GetShaderInfoLog)             \
  X(gl, GetShaderiv)                  \
  X(gl, GetString)                    \
  X(gl, GetStringi)                   \
  X(gl, GetUniformLocation)           \
  X(gl, LinkProgram)                  \
  X(gl, MapNamedBufferRange)          \
  X(gl, MemoryBarrier)                \
  X(gl, NamedBufferData)              \
  X(gl, NamedBufferSubData)           \
  X(gl, NamedFramebufferRenderbuffer) \
  X(gl, NamedRenderbufferStorage)     \
  X(gl, ProgramUniform1i)             \
  X(gl, ProgramUniform1ui)            \
  X(gl, ProgramUniform4uiv)           \
  X(gl, ProgramUniformMatrix4fv)      \
  X(gl, ReadPixels)                   \
  X(gl, ShaderSource)                 \
  X(gl, UnmapNamedBuffer)             \
  X(gl, UseProgram)                   \
  X(gl, VertexArrayElementBuffer)     \
  X(gl, Viewport)

/// Their addresses in one context: gl.DrawArrays(...).
struct GlFunctions {
  /// @throws BackendError if the context has no OpenGL 4.5 or lacks one of the functions.
  explicit GlFunctions(const CurrentContext& current);

  RANGEZIP_GL_FUNCTIONS(RANGEZIP_FUNCTION_MEMBER)
};

}  // namespace rangezip
