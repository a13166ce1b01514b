#include "raster_gl/gl_program.h"

#include <vector>

#include "core/base/error.h"

namespace rangezip {

namespace {

constexpr GLsizei kLogSize = 4000;

[[noreturn]] void fail(const GlDevice& device, const char* name, const char* what,
                       const std::string& log) {
  throw BackendError("OpenGL (" + device.renderer() + "): " + name + " does not " + what + ": " +
                     log.c_str());
}

GlObject compile(const GlDevice& device, const char* name, const ShaderStage& stage) {
  const GlFunctions& gl = device.gl();
  GlObject shader(gl.CreateShader(stage.kind), gl.DeleteShader);
  const char* const source = stage.source.c_str();
  gl.ShaderSource(shader.name(), 1, &source, nullptr);
  gl.CompileShader(shader.name());
  GLint compiled = GL_FALSE;
  gl.GetShaderiv(shader.name(), GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_TRUE) return shader;
  std::string log(kLogSize, '\0');
  gl.GetShaderInfoLog(shader.name(), kLogSize, nullptr, log.data());
  fail(device, name, "compile", log);
}

}  // namespace

GlProgram::GlProgram(const GlDevice& device, const char* name,
                     std::initializer_list<ShaderStage> stages)
    : device_(&device), object_(device.gl().CreateProgram(), device.gl().DeleteProgram) {
  const GlFunctions& gl = device.gl();
  std::vector<GlObject> shaders;  // until the program is linked
  for (const ShaderStage& stage : stages) {
    shaders.push_back(compile(device, name, stage));
    gl.AttachShader(object_.name(), shaders.back().name());
  }
  gl.LinkProgram(object_.name());
  GLint linked = GL_FALSE;
  gl.GetProgramiv(object_.name(), GL_LINK_STATUS, &linked);
  if (linked == GL_TRUE) return;
  std::string log(kLogSize, '\0');
  gl.GetProgramInfoLog(object_.name(), kLogSize, nullptr, log.data());
  fail(device, name, "link", log);
}

void GlProgram::set(const char* uniform, int value) const {
  const GLint location = device_->gl().GetUniformLocation(name(), uniform);
  device_->gl().ProgramUniform1i(name(), location, value);
}

void GlProgram::set(const char* uniform, unsigned value) const {
  const GLint location = device_->gl().GetUniformLocation(name(), uniform);
  device_->gl().ProgramUniform1ui(name(), location, value);
}

void GlProgram::set(const char* uniform, const glm::mat4& value) const {
  const GLint location = device_->gl().GetUniformLocation(name(), uniform);
  device_->gl().ProgramUniformMatrix4fv(name(), location, 1, GL_FALSE, &value[0][0]);
}

void GlProgram::set(const char* uniform,
                    std::span<const std::array<std::uint32_t, 4>> values) const {
  const GLint location = device_->gl().GetUniformLocation(name(), uniform);
  device_->gl().ProgramUniform4uiv(name(), location, static_cast<GLsizei>(values.size()),
                                   values.front().data());
}

}  // namespace rangezip
