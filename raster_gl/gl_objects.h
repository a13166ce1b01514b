#pragma once

#include <functional>
#include <utility>

#include "raster_gl/gl_functions.h"

namespace rangezip {

/// Owns the name of an OpenGL object; can be moved, not copied. Must be destroyed while its context
/// is current.
class GlObject {
 public:
  GlObject(GLuint name, std::function<void(GLuint)> destroy)
      : name_(name), destroy_(std::move(destroy)) {}
  ~GlObject() {
    if (destroy_) destroy_(name_);
  }
  GlObject(GlObject&& other) noexcept
      : name_(other.name_), destroy_(std::exchange(other.destroy_, nullptr)) {}
  GlObject& operator=(GlObject&&) = delete;

  [[nodiscard]] GLuint name() const noexcept { return name_; }

 private:
  GLuint name_;
  std::function<void(GLuint)> destroy_;
};

/// For the objects that OpenGL makes and deletes in arrays:
/// make_object(gl.CreateFramebuffers, gl.DeleteFramebuffers).
[[nodiscard]] inline GlObject make_object(void(APIENTRYP create)(GLsizei, GLuint*),
                                          void(APIENTRYP destroy)(GLsizei, const GLuint*)) {
  GLuint name = 0;
  create(1, &name);
  return {name, [destroy](GLuint n) { destroy(1, &n); }};
}

}  // namespace rangezip
