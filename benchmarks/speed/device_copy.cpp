#include "benchmarks/speed/device_copy.h"

#include <memory>

#include "raster_gl/context_list.h"
#include "raster_gl/gl_buffer.h"

namespace rangezip::benchmark {

namespace {

/// So that starting and waiting for the device do not count.
constexpr int kCopies = 16;

/// Two buffers of a context.
class DeviceCopy {
 public:
  DeviceCopy(const std::string& context, std::size_t bytes)
      : bytes_(bytes), context_(make_gl_context(context)) {
    const CurrentContext current(*context_);
    // Only a benchmark copies.
    copy_ = reinterpret_cast<PFNGLCOPYNAMEDBUFFERSUBDATAPROC>(
        context_->function("glCopyNamedBufferSubData"));
    objects_ = std::make_unique<Objects>(current);
    for (GlBuffer* const buffer : {&objects_->from, &objects_->to}) {
      buffer->reserve(bytes, "a copy");
      buffer->fill(bytes, 0);  // memory that was never written may not be there yet
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
    for (int i = 0; i < kCopies; ++i) {
      copy_(objects_->from.name(), objects_->to.name(), 0, 0, static_cast<GLsizeiptr>(bytes_));
    }
    objects_->device.gl().Finish();
    objects_->device.check("copying a buffer");
  }

 private:
  struct Objects {
    explicit Objects(const CurrentContext& current) : device(current, {}) {}
    GlDevice device;
    GlBuffer from{device};
    GlBuffer to{device};
  };

  std::size_t bytes_;
  std::unique_ptr<GlContext> context_;
  std::unique_ptr<Objects> objects_;
  PFNGLCOPYNAMEDBUFFERSUBDATAPROC copy_ = nullptr;
};

}  // namespace

Case device_copy_case(const std::string& context, std::size_t bytes, bool is_by_wall) {
  const auto copy = std::make_shared<DeviceCopy>(context, bytes);
  return {.name = {{"what", "device copy"}, {"context", context}, {"buffer_bytes", bytes}},
          .items = static_cast<double>(kCopies) * static_cast<double>(bytes),
          .work = [copy] { copy->run(); },
          .is_by_wall = is_by_wall};
}

}  // namespace rangezip::benchmark
