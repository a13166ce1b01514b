#include "raster_gl/egl_context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <cstddef>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "raster_gl/function_table.h"
#include "raster_gl/shared_library.h"

namespace rangezip {

namespace {

/// The functions of EGL itself; those of OpenGL come through GetProcAddress.
#define RANGEZIP_EGL_FUNCTIONS(X) \
  X(egl, BindAPI)                 \
  X(egl, CreateContext)           \
  X(egl, DestroyContext)          \
  X(egl, GetError)                \
  X(egl, GetProcAddress)          \
  X(egl, Initialize)              \
  X(egl, MakeCurrent)             \
  X(egl, QueryString)

struct EglFunctions {
  explicit EglFunctions(const SharedLibrary& library) {
    const auto find = [&](const char* name, auto& function) { library.find(name, function); };
    RANGEZIP_EGL_FUNCTIONS(RANGEZIP_FIND_FUNCTION)
  }
  RANGEZIP_EGL_FUNCTIONS(RANGEZIP_FUNCTION_MEMBER)

  [[noreturn]] void fail(const std::string& what) const {
    constexpr int kHex = 16;
    std::string digits;
    for (int code = GetError(); code > 0; code /= kHex)
      digits.insert(digits.begin(), "0123456789abcdef"[code % kHex]);
    throw BackendError("EGL: " + what + " (error 0x" + digits + ")");
  }

  /// Whether the display (or EGL itself, without one) has the extension.
  [[nodiscard]] bool has(EGLDisplay display, const std::string& extension) const {
    const char* const list = QueryString(display, EGL_EXTENSIONS);
    const std::string all = list == nullptr ? " " : " " + std::string(list) + " ";
    return all.find(" " + extension + " ") != std::string::npos;
  }

  /// @throws BackendError unless has()
  void require(EGLDisplay display, const std::string& extension) const {
    if (!has(display, extension)) throw BackendError("EGL: there is no extension " + extension);
  }

  /// A function of an extension; null would be a defect of the driver.
  template <class Function>
  void find(const char* name, Function& function) const {
    function = reinterpret_cast<Function>(GetProcAddress(name));
    if (function == nullptr) throw BackendError(std::string("EGL: there is no function ") + name);
  }
};

std::vector<EGLDeviceEXT> list_devices(const EglFunctions& egl) {
  // The older extension of which that is a part; NVIDIA's driver names it alone.
  if (!egl.has(EGL_NO_DISPLAY, "EGL_EXT_device_base")) {
    egl.require(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration");
  }
  PFNEGLQUERYDEVICESEXTPROC query_devices = nullptr;
  egl.find("eglQueryDevicesEXT", query_devices);
  EGLint count = 0;
  if (query_devices(0, nullptr, &count) != EGL_TRUE) egl.fail("cannot count the devices");
  std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
  if (query_devices(count, devices.data(), &count) != EGL_TRUE) egl.fail("cannot list devices");
  devices.resize(static_cast<std::size_t>(count));
  return devices;
}

EGLDisplay get_display(const EglFunctions& egl, EGLenum platform, void* native) {
  PFNEGLGETPLATFORMDISPLAYEXTPROC get_platform_display = nullptr;
  egl.find("eglGetPlatformDisplayEXT", get_platform_display);
  const EGLDisplay display = get_platform_display(platform, native, nullptr);
  if (display == EGL_NO_DISPLAY) egl.fail("there is no display without a screen");
  EGLint major = 0;
  EGLint minor = 0;
  // Displays are shared by the whole process and never ended: that would end other contexts.
  if (egl.Initialize(display, &major, &minor) != EGL_TRUE) egl.fail("the display does not start");
  return display;
}

class EglContext final : public GlContext {
 public:
  EglContext(const EglFunctions& egl, EGLDisplay display, std::string name)
      : egl_(egl), display_(display), name_(std::move(name)) {
    egl_.require(display_, "EGL_KHR_surfaceless_context");
    egl_.require(display_, "EGL_KHR_no_config_context");
    egl_.BindAPI(EGL_OPENGL_API);
    // With a strategy for resets the loss of the device becomes an error that glGetError tells.
    // Not every driver knows one.
    context_ = create({EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY, EGL_LOSE_CONTEXT_ON_RESET});
    if (context_ == EGL_NO_CONTEXT) context_ = create({});
    if (context_ == EGL_NO_CONTEXT) egl_.fail("there is no OpenGL 4.5 core context");
  }
  ~EglContext() override { egl_.DestroyContext(display_, context_); }

  [[nodiscard]] std::string name() const override { return name_; }

  [[nodiscard]] Function function(const char* name) const override {
    return egl_.GetProcAddress(name);
  }

 private:
  [[nodiscard]] EGLContext create(std::vector<EGLint> attributes) const {
    attributes.insert(attributes.end(), {EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5,
                                         EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                         EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE});
    return egl_.CreateContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
  }
  void make_current() override {
    egl_.BindAPI(EGL_OPENGL_API);  // a thread that has not used EGL yet stands at OpenGL ES
    if (egl_.MakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE) {
      egl_.fail("the context cannot be made current");
    }
  }
  void release() noexcept override {
    egl_.MakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }

  EglFunctions egl_;
  EGLDisplay display_;
  std::string name_;
  EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::unique_ptr<GlContext> make_egl_device_context(int index, const std::string& library) {
  const EglFunctions egl{SharedLibrary(library)};
  const std::vector<EGLDeviceEXT> devices = list_devices(egl);
  if (index < 0 || static_cast<std::size_t>(index) >= devices.size()) {
    throw BackendError("EGL: there is no device " + std::to_string(index) + ", only " +
                       std::to_string(devices.size()) + " in all, counted from 0");
  }
  egl.require(EGL_NO_DISPLAY, "EGL_EXT_platform_device");
  const EGLDisplay display =
      get_display(egl, EGL_PLATFORM_DEVICE_EXT, devices[static_cast<std::size_t>(index)]);
  return std::make_unique<EglContext>(egl, display, "egl:" + std::to_string(index));
}

std::unique_ptr<GlContext> make_egl_surfaceless_context(const std::string& library) {
  const EglFunctions egl{SharedLibrary(library)};
  egl.require(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless");
  const EGLDisplay display = get_display(egl, EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY);
  return std::make_unique<EglContext>(egl, display, "egl:surfaceless");
}

int count_egl_devices(const std::string& library) {
  return static_cast<int>(list_devices(EglFunctions{SharedLibrary(library)}).size());
}

}  // namespace rangezip
