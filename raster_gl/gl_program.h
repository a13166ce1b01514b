#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>

#include <glm/mat4x4.hpp>

#include "raster_gl/gl_device.h"
#include "raster_gl/gl_objects.h"

namespace rangezip {

/// One stage of a program: GL_COMPUTE_SHADER and its source.
struct ShaderStage {
  GLenum kind = GL_COMPUTE_SHADER;
  std::string source;
};

/// A linked program.
class GlProgram {
 public:
  /// @param name for the text of an error
  /// @throws BackendError with the driver's log if a stage does not compile or link
  GlProgram(const GlDevice& device, const char* name, std::initializer_list<ShaderStage> stages);

  [[nodiscard]] GLuint name() const noexcept { return object_.name(); }

  /// Sets a uniform; one that the program does not use is left out.
  void set(const char* uniform, int value) const;
  void set(const char* uniform, unsigned value) const;
  void set(const char* uniform, const glm::mat4& value) const;
  /// An array of uvec4.
  void set(const char* uniform, std::span<const std::array<std::uint32_t, 4>> values) const;

 private:
  const GlDevice* device_;
  GlObject object_;
};

}  // namespace rangezip
