#include "raster_gl/osmesa_context.h"

#include <GL/osmesa.h>

#include <array>
#include <cstddef>

#include "core/base/error.h"
#include "raster_gl/function_table.h"
#include "raster_gl/shared_library.h"

namespace rangezip {

namespace {

/// The functions of the library itself; those of OpenGL come through GetProcAddress.
#define RANGEZIP_OSMESA_FUNCTIONS(X) \
  X(OSMesa, CreateContextAttribs)    \
  X(OSMesa, DestroyContext)          \
  X(OSMesa, MakeCurrent)             \
  X(OSMesa, GetProcAddress)

struct OsmesaFunctions {
  explicit OsmesaFunctions(const SharedLibrary& library) {
    const auto find = [&](const char* name, auto& function) { library.find(name, function); };
    RANGEZIP_OSMESA_FUNCTIONS(RANGEZIP_FIND_FUNCTION)
  }
  RANGEZIP_OSMESA_FUNCTIONS(RANGEZIP_FUNCTION_MEMBER)
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
    context_ = osmesa_.CreateContextAttribs(kAttributes.data(), nullptr);
    if (context_ == nullptr) {
      throw BackendError(library.name() + " offers no OpenGL 4.5 core context");
    }
  }
  ~OsmesaContext() override { osmesa_.DestroyContext(context_); }

  [[nodiscard]] std::string name() const override { return "osmesa"; }

  [[nodiscard]] Function function(const char* name) const override {
    return osmesa_.GetProcAddress(name);
  }

 private:
  void make_current() override {
    if (osmesa_.MakeCurrent(context_, window_.data(), GL_UNSIGNED_BYTE, kSide, kSide) != GL_TRUE) {
      throw BackendError("OSMesaMakeCurrent refuses the context");
    }
  }
  void release() noexcept override { osmesa_.MakeCurrent(nullptr, nullptr, 0, 0, 0); }

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
