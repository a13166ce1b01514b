#include "raster_gl/hardware_target.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "raster_gl/shader_text.h"

namespace rangezip {

HardwareTarget::HardwareTarget(const GlDevice& device, const Kernels& kernels)
    : device_(device),
      kernels_(kernels),
      ids_(make_object(device.gl().CreateRenderbuffers, device.gl().DeleteRenderbuffers)),
      depths_(make_object(device.gl().CreateRenderbuffers, device.gl().DeleteRenderbuffers)),
      target_(make_object(device.gl().CreateFramebuffers, device.gl().DeleteFramebuffers)),
      vertices_(make_object(device.gl().CreateVertexArrays, device.gl().DeleteVertexArrays)),
      lower_(device),
      upper_(device) {}

void HardwareTarget::resize(const ImagePart& part) {
  const Extent needed{part.extent.width, part.row_count};
  if (needed == allocated_) return;
  const GlFunctions& gl = device_.gl();
  gl.NamedRenderbufferStorage(ids_.name(), GL_R32UI, needed.width, needed.height);
  gl.NamedRenderbufferStorage(depths_.name(), GL_DEPTH_COMPONENT32F, needed.width, needed.height);
  gl.NamedFramebufferRenderbuffer(target_.name(), GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                  ids_.name());
  gl.NamedFramebufferRenderbuffer(target_.name(), GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                                  depths_.name());
  device_.check("making the framebuffer");
  if (gl.CheckNamedFramebufferStatus(target_.name(), GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw BackendError("OpenGL (" + device_.renderer() +
                       "): a framebuffer of R32UI and DEPTH_COMPONENT32F is not complete");
  }
  allocated_ = needed;
}

void HardwareTarget::begin(const ImagePart& part, const DepthBand* band, Projection projection) {
  device_.enter(GlPhase::draw);
  part_ = part;
  resize(part);
  if (band != nullptr) {
    lower_.upload(part.of(band->lower.pixels()), "the band");
    upper_.upload(part.of(band->upper.pixels()), "the band");
    kernels_.bind(Binding::lower, lower_);
    kernels_.bind(Binding::upper, upper_);
  }
  const GlFunctions& gl = device_.gl();
  constexpr GLuint kNothing[4] = {kNoPrimitive, 0, 0, 0};
  constexpr GLfloat kFar = 1.0F;
  gl.ClearNamedFramebufferuiv(target_.name(), GL_COLOR, 0, kNothing);
  gl.ClearNamedFramebufferfv(target_.name(), GL_DEPTH, 0, &kFar);
  gl.BindFramebuffer(GL_FRAMEBUFFER, target_.name());
  gl.BindVertexArray(vertices_.name());
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthFunc(GL_LESS);
  gl.Enable(GL_PROGRAM_POINT_SIZE);
  gl.Disable(GL_MULTISAMPLE);
  gl.Disable(GL_DITHER);
  gl.Disable(GL_CULL_FACE);
  if (projection == Projection::fixed) {
    gl.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    gl.Viewport(-kViewportMargin, -kViewportMargin - part.first_row, kViewportSize, kViewportSize);
  } else {
    gl.ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    gl.Viewport(0, -part.first_row, part.extent.width, part.extent.height);
  }
}

void HardwareTarget::end() const {
  const GlFunctions& gl = device_.gl();
  gl.Disable(GL_CULL_FACE);
  gl.BindVertexArray(0);
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
}

void HardwareTarget::draw(const GlProgram& program, GLenum primitives, std::size_t vertices,
                          const GlBuffer* indices) const {
  const GlFunctions& gl = device_.gl();
  program.set("width", part_.extent.width);
  program.set("first_row", part_.first_row);
  gl.UseProgram(program.name());
  if (indices == nullptr) {
    gl.DrawArrays(primitives, 0, static_cast<GLsizei>(vertices));
  } else {
    gl.VertexArrayElementBuffer(vertices_.name(), indices->name());
    gl.DrawElements(primitives, static_cast<GLsizei>(vertices), GL_UNSIGNED_INT, nullptr);
  }
  // Kernels may write to the buffers that it reads next.
  gl.MemoryBarrier(GL_ALL_BARRIER_BITS);
  device_.check("drawing by fixed functions");
}

void HardwareTarget::read(Framebuffer& out) {
  const PhaseScope phase(device_, GlPhase::read);
  const auto depths = part_.of(out.depth.pixels());
  const auto ids = part_.of(out.id.pixels());
  read_depths_.resize(part_.pixels());
  const GlFunctions& gl = device_.gl();
  gl.ReadPixels(0, 0, part_.extent.width, part_.row_count, GL_RED_INTEGER, GL_UNSIGNED_INT,
                ids.data());
  gl.ReadPixels(0, 0, part_.extent.width, part_.row_count, GL_DEPTH_COMPONENT, GL_FLOAT,
                read_depths_.data());
  device_.check("reading the framebuffer");
  constexpr std::size_t kGrain = std::size_t{1} << 16;
  parallel_for(ids.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto depth = static_cast<std::uint32_t>(read_depths_[i] * 0x1p24F);
      depths[i] = ids[i] == kNoPrimitive ? kNoDepth : std::min(depth, kMaxDepth);
    }
  });
}

}  // namespace rangezip
