#include "raster_gl/osmesa_context.h"

#include <dlfcn.h>

#include <GL/osmesa.h>

#include <array>
#include <cstddef>

#include "core/base/error.h"

namespace rangezip {

namespace {

/// The functions of the library itself; those of OpenGL come through get_proc_address.
struct OsmesaLibrary {
  decltype(&OSMesaCreateContextAttribs) create_context = nullptr;
  decltype(&OSMesaDestroyContext) destroy_context = nullptr;
  decltype(&OSMesaMakeCurrent) make_current = nullptr;
  decltype(&OSMesaGetProcAddress) get_proc_address = nullptr;
};

template <class Function>
void find(void* library, const std::string& library_name, const char* name, Function& function) {
  function = reinterpret_cast<Function>(dlsym(library, name));
  if (function == nullptr) {
    throw BackendError("make_osmesa_context: " + library_name + " has no function " + name);
  }
}

OsmesaLibrary open_library(const std::string& name) {
  // Drivers keep threads and thread-local state, so the library stays loaded to the end of the
  // process (RTLD_NODELETE) and its handle is not needed again.
  void* const library = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  if (library == nullptr) {
    const char* const reason = dlerror();
    throw BackendError("make_osmesa_context: cannot open " + name + ": " +
                       (reason != nullptr ? reason : "no reason given"));
  }
  OsmesaLibrary osmesa;
  find(library, name, "OSMesaCreateContextAttribs", osmesa.create_context);
  find(library, name, "OSMesaDestroyContext", osmesa.destroy_context);
  find(library, name, "OSMesaMakeCurrent", osmesa.make_current);
  find(library, name, "OSMesaGetProcAddress", osmesa.get_proc_address);
  return osmesa;
}

class OsmesaContext final : public GlContext {
 public:
  explicit OsmesaContext(const std::string& library) : osmesa_(open_library(library)) {
    constexpr std::array kAttributes{OSMESA_FORMAT,
                                     OSMESA_RGBA,
                                     OSMESA_PROFILE,
                                     OSMESA_CORE_PROFILE,
                                     OSMESA_CONTEXT_MAJOR_VERSION,
                                     4,
                                     OSMESA_CONTEXT_MINOR_VERSION,
                                     5,
                                     0};
    context_ = osmesa_.create_context(kAttributes.data(), nullptr);
    if (context_ == nullptr) {
      throw BackendError("make_osmesa_context: " + library + " offers no OpenGL 4.5 core context");
    }
  }
  ~OsmesaContext() override { osmesa_.destroy_context(context_); }

  [[nodiscard]] std::string name() const override { return "osmesa"; }

  [[nodiscard]] Function function(const char* name) const override {
    return osmesa_.get_proc_address(name);
  }

 private:
  void make_current() override {
    if (osmesa_.make_current(context_, window_.data(), GL_UNSIGNED_BYTE, kSide, kSide) != GL_TRUE) {
      throw BackendError("OSMesaMakeCurrent refuses the context");
    }
  }
  void release() noexcept override { osmesa_.make_current(nullptr, nullptr, 0, 0, 0); }

  static constexpr int kSide = 16;
  static constexpr std::size_t kBytesPerPixel = 4;

  OsmesaLibrary osmesa_;
  OSMesaContext context_ = nullptr;
  /// The window that a context must have; drawing goes into framebuffer objects.
  std::array<std::byte, kBytesPerPixel * kSide * kSide> window_{};
};

}  // namespace

std::unique_ptr<GlContext> make_osmesa_context(const std::string& library) {
  return std::make_unique<OsmesaContext>(library);
}

}  // namespace rangezip
