#include "raster_gl/gl_probe.h"

#include "core/base/error.h"
#include "raster_gl/gl_functions.h"
#include "raster_gl/gl_objects.h"

namespace rangezip {

namespace {

constexpr Extent kExtent{16, 16};

// The corners in pixels, without any buffer: position = pixels / 8 - 1.
constexpr const char* kVertexShader = R"(#version 450 core
const vec2 corners[3] = vec2[3](vec2(2.0, 2.0), vec2(14.5, 2.0), vec2(2.0, 14.5));
void main() { gl_Position = vec4(corners[gl_VertexID] / 8.0 - 1.0, 0.5, 1.0); }
)";

constexpr const char* kFragmentShader = R"(#version 450 core
layout(location = 0) out uint value;
void main() { value = 0x87654321u; }
)";

std::string text_of(const GlFunctions& gl, GLenum name) {
  const GLubyte* const text = gl.GetString(name);
  return text == nullptr ? std::string() : reinterpret_cast<const char*>(text);
}

GlObject compile(const GlFunctions& gl, GLenum stage, const char* source) {
  GlObject shader(gl.CreateShader(stage), gl.DeleteShader);
  gl.ShaderSource(shader.name(), 1, &source, nullptr);
  gl.CompileShader(shader.name());
  return shader;
}

/// Links two shaders. Errors of compilation show up here too: a program of a shader that failed
/// does not link.
GlObject link(const GlFunctions& gl, const GlObject& vertex, const GlObject& fragment) {
  GlObject program(gl.CreateProgram(), gl.DeleteProgram);
  gl.AttachShader(program.name(), vertex.name());
  gl.AttachShader(program.name(), fragment.name());
  gl.LinkProgram(program.name());
  GLint linked = GL_FALSE;
  gl.GetProgramiv(program.name(), GL_LINK_STATUS, &linked);
  if (linked != GL_TRUE) {
    constexpr GLsizei kLogSize = 2000;
    std::string log(kLogSize, '\0');
    GLsizei length = 0;
    gl.GetProgramInfoLog(program.name(), kLogSize, &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    throw BackendError("probe: the shaders do not link: " + log);
  }
  return program;
}

void draw_triangle(const GlFunctions& gl, Grid<std::uint32_t>& image) {
  const GlObject color = make_object(gl.CreateRenderbuffers, gl.DeleteRenderbuffers);
  gl.NamedRenderbufferStorage(color.name(), GL_R32UI, kExtent.width, kExtent.height);
  const GlObject target = make_object(gl.CreateFramebuffers, gl.DeleteFramebuffers);
  gl.NamedFramebufferRenderbuffer(target.name(), GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                  color.name());
  if (gl.CheckNamedFramebufferStatus(target.name(), GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw BackendError("probe: an R32UI framebuffer is not complete");
  }
  const GlObject vertex = compile(gl, GL_VERTEX_SHADER, kVertexShader);
  const GlObject fragment = compile(gl, GL_FRAGMENT_SHADER, kFragmentShader);
  const GlObject program = link(gl, vertex, fragment);
  const GlObject no_attributes = make_object(gl.CreateVertexArrays, gl.DeleteVertexArrays);

  constexpr GLuint kNothing[4] = {0, 0, 0, 0};
  gl.ClearNamedFramebufferuiv(target.name(), GL_COLOR, 0, kNothing);
  gl.BindFramebuffer(GL_FRAMEBUFFER, target.name());
  gl.Viewport(0, 0, kExtent.width, kExtent.height);
  gl.UseProgram(program.name());
  gl.BindVertexArray(no_attributes.name());
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
  gl.ReadPixels(0, 0, kExtent.width, kExtent.height, GL_RED_INTEGER, GL_UNSIGNED_INT,
                image.pixels().data());
  gl.UseProgram(0);
  gl.BindVertexArray(0);
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
  if (const GLenum error = gl.GetError(); error != GL_NO_ERROR) {
    throw BackendError("probe: OpenGL reports error " + std::to_string(error));
  }
}

}  // namespace

GlProbe probe(GlContext& context) {
  const CurrentContext current(context);
  const GlFunctions gl(current);
  GlProbe result{.version = text_of(gl, GL_VERSION),
                 .renderer = text_of(gl, GL_RENDERER),
                 .image = Grid<std::uint32_t>(kExtent)};
  draw_triangle(gl, result.image);
  return result;
}

}  // namespace rangezip
