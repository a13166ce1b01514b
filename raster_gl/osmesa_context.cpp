#include "raster_gl/osmesa_context.h"

#include <GL/osmesa.h>

#include <array>
#include <cstddef>

#include "core/base/error.h"
#include "raster_gl/shared_library.h"

namespace rangezip {

namespace {

/// The functions of the library itself; those of OpenGL come through get_proc_address.
struct OsmesaFunctions {
  decltype(&OSMesaCreateContextAttribs) create_context = nullptr;
  decltype(&OSMesaDestroyContext) destroy_context = nullptr;
  decltype(&OSMesaMakeCurrent) make_current = nullptr;
  decltype(&OSMesaGetProcAddress) get_proc_address = nullptr;

  explicit OsmesaFunctions(const SharedLibrary& library) {
    library.find("OSMesaCreateContextAttribs", create_context);
    library.find("OSMesaDestroyContext", destroy_context);
    library.find("OSMesaMakeCurrent", make_current);
    library.find("OSMesaGetProcAddress", get_proc_address);
  }
};

class OsmesaContext final : public GlContext {
 public:
  explicit OsmesaContext(const SharedLibrary& library) : osmesa_(library) {
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
      throw BackendError(library.name() + " offers no OpenGL 4.5 core context");
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

  OsmesaFunctions osmesa_;
  OSMesaContext context_ = nullptr;
  /// The window that a context must have; drawing goes into framebuffer objects.
  std::array<std::byte, kBytesPerPixel * kSide * kSide> window_{};
};

}  // namespace

std::unique_ptr<GlContext> make_osmesa_context(const std::string& library) {
  return std::make_unique<OsmesaContext>(SharedLibrary(library));
}

}  // namespace rangezip
