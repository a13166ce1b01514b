#include "raster_gl/gl_device.h"

#include <string_view>
#include <utility>

#include "core/base/error.h"

namespace rangezip {

/// What the driver said of its last error.
struct GlDevice::DebugLog {
  std::string last_error;

  static void APIENTRY add(GLenum /*source*/, GLenum type, GLuint /*id*/, GLenum /*severity*/,
                           GLsizei /*length*/, const GLchar* message, const void* log) {
    if (type != GL_DEBUG_TYPE_ERROR) return;
    static_cast<DebugLog*>(const_cast<void*>(log))->last_error = message;
  }
};

namespace {

std::string text_of(const GlFunctions& gl, GLenum name) {
  const GLubyte* const text = gl.GetString(name);
  return text == nullptr ? std::string() : reinterpret_cast<const char*>(text);
}

bool has_extension(const GlFunctions& gl, std::string_view name) {
  GLint count = 0;
  gl.GetIntegerv(GL_NUM_EXTENSIONS, &count);
  for (GLint i = 0; i < count; ++i) {
    const GLubyte* const text = gl.GetStringi(GL_EXTENSIONS, static_cast<GLuint>(i));
    if (text != nullptr && reinterpret_cast<const char*>(text) == name) return true;
  }
  return false;
}

void require_extension(const GlFunctions& gl, const char* name) {
  if (has_extension(gl, name)) return;
  throw BackendError(std::string("OpenGL: the driver has no extension ") + name);
}

void require_at_least(const GlFunctions& gl, GLenum limit, const char* name, GLint least) {
  GLint value = 0;
  gl.GetIntegerv(limit, &value);
  if (value >= least) return;
  throw BackendError("OpenGL: " + std::string(name) + " must be at least " + std::to_string(least) +
                     ", the driver has " + std::to_string(value));
}

/// Kinds of errors that OpenGL may keep at a time, and some more.
constexpr int kMostErrors = 10;

std::string name_of(GLenum error) {
  switch (error) {
    case GL_OUT_OF_MEMORY:
      return "out of memory";
    case GL_CONTEXT_LOST:
      return "the context was lost";
    case GL_INVALID_OPERATION:
      return "invalid operation";
    case GL_INVALID_VALUE:
      return "invalid value";
    default:
      return "error " + std::to_string(error);
  }
}

}  // namespace

GlDevice::GlDevice(const CurrentContext& current, GlPhaseObserver observer)
    : gl_(current),
      log_(std::make_unique<DebugLog>()),
      read_back_(std::make_unique<ReadBack>(gl_)),
      observer_(std::move(observer)),
      renderer_(text_of(gl_, GL_RENDERER)),
      version_(text_of(gl_, GL_VERSION)) {
  require_extension(gl_, "GL_ARB_gpu_shader_int64");
  constexpr GLint kBlocks = 9;     // of the kernel that sums
  constexpr GLint kBindings = 16;  // gl_kernels.h
  require_at_least(gl_, GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS,
                   "GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS", kBlocks);
  require_at_least(gl_, GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS,
                   "GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS", kBindings);
  GLint64 bytes = 0;
  gl_.GetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &bytes);
  block_bytes_ = static_cast<std::size_t>(bytes);
  has_atomic_int64_ = has_extension(gl_, "GL_NV_shader_atomic_int64");
  gl_.Enable(GL_DEBUG_OUTPUT);
  gl_.Enable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  gl_.DebugMessageCallback(DebugLog::add, log_.get());
  check("starting");
}

GlDevice::~GlDevice() {
  gl_.DebugMessageCallback(nullptr, nullptr);
}

void GlDevice::check(const char* stage) const {
  GLenum error = gl_.GetError();
  // Several errors may be waiting: what is left of them must not be the next call's. A lost context
  // never runs out.
  for (int i = 0; error != GL_NO_ERROR && i < kMostErrors; ++i) {
    if (gl_.GetError() == GL_NO_ERROR) break;
  }
  if (error == GL_NO_ERROR && gl_.GetGraphicsResetStatus() != GL_NO_ERROR) error = GL_CONTEXT_LOST;
  if (error == GL_NO_ERROR) return;
  std::string text = "OpenGL (" + renderer_ + "), " + stage + ": " + name_of(error);
  if (!log_->last_error.empty()) text += "; the driver says: " + log_->last_error;
  log_->last_error.clear();
  throw BackendError(text);
}

void GlDevice::read(GLuint buffer, std::size_t offset, std::span<std::byte> bytes) const {
  constexpr const char* kStage = "reading a buffer";
  const bool is_read = read_back_->read(buffer, offset, bytes);
  check(kStage);
  // The driver may take what is mapped away, as when a screen's mode changes.
  if (!is_read)
    throw BackendError("OpenGL (" + renderer_ + "), " + kStage + ": what was read is lost");
}

GlPhase GlDevice::enter(GlPhase phase) const {
  if (!observer_) return phase;
  gl_.Finish();
  observer_(phase);
  return std::exchange(phase_, phase);
}

}  // namespace rangezip
