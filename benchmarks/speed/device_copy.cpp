#include "benchmarks/speed/device_copy.h"

#include <cstdint>
#include <memory>

#include "raster_gl/context_list.h"
#include "raster_gl/gl_buffer.h"
#include "raster_gl/gl_kernels.h"
#include "raster_gl/gl_program.h"

namespace rangezip::benchmark {

namespace {

/// So that starting and waiting for the device do not count.
constexpr int kCopies = 16;

constexpr std::size_t kGroup = 256;
constexpr std::size_t kBytesEach = 16;  ///< of an invocation
constexpr const char* kCopyKernel = R"(#version 450 core
layout(local_size_x = 256) in;
layout(std430, binding = 0) readonly buffer From { uvec4 from[]; };
layout(std430, binding = 1) writeonly buffer To { uvec4 to[]; };
uniform uint count;

void main() {
  uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  uint i = group * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
  if (i < count) to[i] = from[i];
}
)";

/// Two buffers of a context.
class DeviceCopy {
 public:
  DeviceCopy(const std::string& context, std::size_t bytes, bool is_by_kernel)
      : bytes_(bytes / kBytesEach * kBytesEach), context_(make_gl_context(context)) {
    const CurrentContext current(*context_);
    // Only a benchmark copies.
    copy_ = reinterpret_cast<PFNGLCOPYNAMEDBUFFERSUBDATAPROC>(
        context_->function("glCopyNamedBufferSubData"));
    objects_ = std::make_unique<Objects>(current);
    for (GlBuffer* const buffer : {&objects_->from, &objects_->to}) {
      buffer->reserve(bytes_, "a copy");
      objects_->kernels.fill(*buffer, bytes_,
                             0);  // memory that was never written may not be there yet
    }
    if (is_by_kernel) {
      objects_->kernel = std::make_unique<GlProgram>(
          objects_->device, "copy",
          std::initializer_list<ShaderStage>{{GL_COMPUTE_SHADER, kCopyKernel}});
    }
  }
  ~DeviceCopy() {
    const CurrentContext current(*context_);
    objects_.reset();
  }
  DeviceCopy(const DeviceCopy&) = delete;
  DeviceCopy& operator=(const DeviceCopy&) = delete;

  void run() const {
    const CurrentContext current(*context_);
    for (int i = 0; i < kCopies; ++i)
      copy_once();
    objects_->device.gl().Finish();
    objects_->device.check("copying a buffer");
  }

 private:
  void copy_once() const {
    if (objects_->kernel == nullptr) {
      copy_(objects_->from.name(), objects_->to.name(), 0, 0, static_cast<GLsizeiptr>(bytes_));
      return;
    }
    const std::size_t count = bytes_ / kBytesEach;
    objects_->kernels.bind(Binding{0}, objects_->from);
    objects_->kernels.bind(Binding{1}, objects_->to);
    objects_->kernel->set("count", static_cast<unsigned>(count));
    objects_->kernels.dispatch(*objects_->kernel, groups_of(count, kGroup));
  }

  struct Objects {
    explicit Objects(const CurrentContext& current) : device(current, {}) {}
    GlDevice device;
    Kernels kernels{device};
    GlBuffer from{device};
    GlBuffer to{device};
    std::unique_ptr<GlProgram> kernel;  ///< null: the driver's own copying
  };

  std::size_t bytes_;
  std::unique_ptr<GlContext> context_;
  std::unique_ptr<Objects> objects_;
  PFNGLCOPYNAMEDBUFFERSUBDATAPROC copy_ = nullptr;
};

Case copy_case(const std::string& context, std::size_t bytes, bool is_by_wall, bool is_by_kernel) {
  const auto copy = std::make_shared<DeviceCopy>(context, bytes, is_by_kernel);
  return {.name = {{"what", "device copy"},
                   {"context", context},
                   {"by", is_by_kernel ? "kernel" : "driver"},
                   {"buffer_bytes", bytes}},
          .items = static_cast<double>(kCopies) * static_cast<double>(bytes),
          .work = [copy] { copy->run(); },
          .is_by_wall = is_by_wall};
}

}  // namespace

std::vector<Case> device_copy_cases(const std::string& context, std::size_t bytes,
                                    bool is_by_wall) {
  return {copy_case(context, bytes, is_by_wall, false),
          copy_case(context, bytes, is_by_wall, true)};
}

}  // namespace rangezip::benchmark
