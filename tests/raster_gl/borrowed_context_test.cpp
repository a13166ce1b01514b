// Contexts that belong to an application: a window's in a viewer, EGL's without a surface here.
#include "raster_gl/borrowed_context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/glcorearb.h>

#include <array>
#include <catch2/catch.hpp>
#include <map>
#include <stdexcept>
#include <thread>

#include "core/base/error.h"
#include "raster_cpu/cpu_rasterizer.h"
#include "raster_gl/context_list.h"
#include "raster_gl/gl_rasterizer.h"
#include "raster_gl/shared_library.h"
#include "tests/support/raster_fuzz.h"

namespace rangezip {
namespace {

using Catch::Contains;

/// An application with contexts of its own, as a window library makes them. Each has a buffer with
/// the application's data, so that the application can tell whether it still draws there.
class Application {
 public:
  Application() {
    const SharedLibrary library("libEGL.so.1");
    library.find("eglBindAPI", bind_api_);
    library.find("eglCreateContext", create_context_);
    library.find("eglDestroyContext", destroy_context_);
    library.find("eglGetCurrentContext", get_current_context_);
    library.find("eglGetProcAddress", get_proc_address_);
    library.find("eglMakeCurrent", make_current_);
    const auto get_display = gl<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
    display_ = get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    decltype(&eglInitialize) initialize = nullptr;
    library.find("eglInitialize", initialize);
    REQUIRE(initialize(display_, nullptr, nullptr) == EGL_TRUE);
    window = make_context();
    other = make_context();
  }
  ~Application() {
    make_current(nullptr);
    destroy_context_(display_, window);
    destroy_context_(display_, other);
  }
  Application(const Application&) = delete;
  Application& operator=(const Application&) = delete;

  void make_current(void* context) const {
    bind_api_(EGL_OPENGL_API);
    make_current_(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context);
  }
  [[nodiscard]] void* current() const { return get_current_context_(); }

  [[nodiscard]] ContextSwitch contexts() const {
    return {.current = [this] { return current(); },
            .make_current = [this](void* context) { make_current(context); }};
  }
  [[nodiscard]] BorrowedContext lend_window() const {
    return {.context = window, .contexts = contexts(), .function = [this](const char* name) {
              return get_proc_address_(name);
            }};
  }

  template <class Function>
  [[nodiscard]] Function gl(const char* name) const {
    return reinterpret_cast<Function>(get_proc_address_(name));
  }

  /// Stores a number in a buffer of the context that is current.
  void store(GLuint number) {
    GLuint& buffer = buffers_[number];
    gl<PFNGLCREATEBUFFERSPROC>("glCreateBuffers")(1, &buffer);
    gl<PFNGLNAMEDBUFFERDATAPROC>("glNamedBufferData")(buffer, sizeof(number), &number,
                                                      GL_STATIC_DRAW);
  }
  /// Whether OpenGL's context is the one in which this number was stored. EGL's word does not
  /// count: the driver may have another context at work than EGL thinks.
  [[nodiscard]] bool has_stored(GLuint number) const {
    GLuint found = 0;
    gl<PFNGLGETNAMEDBUFFERSUBDATAPROC>("glGetNamedBufferSubData")(buffer_of(number), 0,
                                                                  sizeof(found), &found);
    return found == number;
  }

  [[nodiscard]] GLuint buffer_of(GLuint number) const { return buffers_.at(number); }

  EGLContext window = EGL_NO_CONTEXT;
  EGLContext other = EGL_NO_CONTEXT;

 private:
  [[nodiscard]] EGLContext make_context() const {
    constexpr std::array kAttributes{EGL_CONTEXT_MAJOR_VERSION,
                                     4,
                                     EGL_CONTEXT_MINOR_VERSION,
                                     5,
                                     EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                     EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                     EGL_NONE};
    bind_api_(EGL_OPENGL_API);
    const EGLContext context =
        create_context_(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, kAttributes.data());
    REQUIRE(context != EGL_NO_CONTEXT);
    return context;
  }

  decltype(&eglBindAPI) bind_api_ = nullptr;
  decltype(&eglCreateContext) create_context_ = nullptr;
  decltype(&eglDestroyContext) destroy_context_ = nullptr;
  decltype(&eglGetCurrentContext) get_current_context_ = nullptr;
  decltype(&eglGetProcAddress) get_proc_address_ = nullptr;
  decltype(&eglMakeCurrent) make_current_ = nullptr;
  EGLDisplay display_ = EGL_NO_DISPLAY;
  std::map<GLuint, GLuint> buffers_;  // of numbers stored
};

/// Draws one scene of each family and compares it with scalar code.
void check_scenes(Rasterizer& rasterizer, std::uint64_t seed) {
  CpuRasterizer reference("scalar");
  fuzz::Drawings found;
  for (std::uint64_t scene = 0; scene < kSceneFamilies; ++scene) {
    CAPTURE(seed, scene);
    const fuzz::Case drawn = fuzz::make_case(seed, scene, reference);
    fuzz::draw(rasterizer, drawn, found);
    REQUIRE_FALSE(fuzz::find_difference(drawn, found));
  }
}

TEST_CASE("in a context of the application the bits of the processor are drawn") {
  Application application;
  for (const GlStrategy strategy : {GlStrategy::compute, GlStrategy::fixed_function}) {
    GlRasterizer rasterizer(borrow_context(application.lend_window()), {.strategy = strategy});
    CHECK_THAT(rasterizer.info().name,
               Catch::StartsWith("gl:window, ") && Catch::Contains(", " + name_of(strategy)));
    check_scenes(rasterizer, 11);
  }
}

TEST_CASE("what the application has current stays so: the window's context, another, or none") {
  Application application;
  application.make_current(application.window);
  application.store(71);
  application.make_current(application.other);
  application.store(72);
  for (void* const before : {application.window, application.other, EGL_NO_CONTEXT}) {
    application.make_current(before);
    const auto check_before = [&] {
      CHECK(application.current() == before);
      CHECK(application.has_stored(71) == (before == application.window));
      CHECK(application.has_stored(72) == (before == application.other));
    };
    {
      GlRasterizer rasterizer(borrow_context(application.lend_window()));
      check_before();
      check_scenes(rasterizer, 12);
      check_before();
    }
    check_before();
    const auto context = borrow_context(application.lend_window());
    CHECK_THROWS_AS(
        [&] {
          const CurrentContext current(*context);
          CHECK(application.has_stored(71));
          throw std::runtime_error("while drawing");
        }(),
        std::runtime_error);
    check_before();
  }
}

TEST_CASE("the application, its window, OSMesa and EGL draw different scenes in turn") {
  Application application;
  application.make_current(application.window);
  application.store(73);
  GlRasterizer window(borrow_context(application.lend_window()));
  GlRasterizer osmesa(beside_application(make_gl_context("osmesa"), application.contexts()));
  GlRasterizer egl(beside_application(make_gl_context("egl:surfaceless"), application.contexts()));
  CpuRasterizer reference("scalar");
  fuzz::Drawings found;
  for (void* const before : {application.window, EGL_NO_CONTEXT}) {
    application.make_current(before);
    for (std::uint64_t scene = 0; scene < kSceneFamilies; ++scene) {
      std::uint64_t seed = 200;
      for (GlRasterizer* rasterizer : {&window, &osmesa, &egl}) {
        CAPTURE(seed, scene);
        const fuzz::Case drawn = fuzz::make_case(seed++, scene, reference);
        fuzz::draw(*rasterizer, drawn, found);
        REQUIRE_FALSE(fuzz::find_difference(drawn, found));
        REQUIRE(application.current() == before);
        REQUIRE(application.has_stored(73) == (before == application.window));
      }
    }
  }
}

TEST_CASE("a window's context works again after a context of another kind took its place") {
  // What beside_application() prevents. EGL calls the window's context current all the time.
  Application application;
  application.make_current(application.window);
  application.store(74);
  GlRasterizer window(borrow_context(application.lend_window()));
  GlRasterizer osmesa(make_gl_context("osmesa"));
  check_scenes(window, 13);
  CHECK(application.has_stored(74));
}

TEST_CASE("kernels draw the same whatever state the application has set for its own drawing") {
  Application application;
  GlRasterizer rasterizer(borrow_context(application.lend_window()));
  REQUIRE(rasterizer.strategy() == GlStrategy::compute);
  application.make_current(application.window);
  application.gl<PFNGLSCISSORPROC>("glScissor")(0, 0, 1, 1);
  for (const GLenum state :
       std::array<GLenum, 4>{GL_SCISSOR_TEST, GL_RASTERIZER_DISCARD, GL_STENCIL_TEST, GL_BLEND})
    application.gl<PFNGLENABLEPROC>("glEnable")(state);
  application.gl<PFNGLCOLORMASKPROC>("glColorMask")(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  application.gl<PFNGLPIXELSTOREIPROC>("glPixelStorei")(GL_PACK_ROW_LENGTH, 3);
  application.store(75);
  for (const GLenum target : std::array<GLenum, 2>{GL_PIXEL_PACK_BUFFER, GL_PIXEL_UNPACK_BUFFER})
    application.gl<PFNGLBINDBUFFERPROC>("glBindBuffer")(target, application.buffer_of(75));
  check_scenes(rasterizer, 14);
  CHECK(application.has_stored(75));
}

TEST_CASE("a context that cannot be made current is an error that names it") {
  Application application;
  GlRasterizer rasterizer(borrow_context(application.lend_window()));
  application.make_current(application.window);
  application.store(76);
  CpuRasterizer reference("scalar");
  const fuzz::Case drawn = fuzz::make_case(15, 0, reference);
  fuzz::Drawings found;
  std::string text;
  std::thread([&] {  // while the window's context is current on this one
    try {
      fuzz::draw(rasterizer, drawn, found);
    } catch (const BackendError& error) {
      text = error.what();
    }
  })
      .join();
  CHECK_THAT(text, Contains("context window: cannot be made current"));
  CHECK(application.current() == application.window);
  CHECK(application.has_stored(76));
  check_scenes(rasterizer, 15);

  BorrowedContext refused = application.lend_window();
  refused.name = "hidden window";
  refused.contexts.make_current = [&](void* context) {
    if (context != application.other) application.make_current(context);
  };
  refused.context = application.other;
  application.make_current(application.window);
  CHECK_THROWS_AS(GlRasterizer(borrow_context(refused)), BackendError);
  CHECK_THROWS_WITH(GlRasterizer(borrow_context(refused)), Contains("context hidden window: "));
  CHECK(application.has_stored(76));
}

TEST_CASE("what an application must give to lend a context is named where it is missing") {
  Application application;
  const auto without = [&](const auto& remove) {
    BorrowedContext borrowed = application.lend_window();
    remove(borrowed);
    return borrowed;
  };
  CHECK_THROWS_WITH(borrow_context(without([](auto& b) { b.context = nullptr; })),
                    Contains("borrow_context: context must be given"));
  CHECK_THROWS_WITH(borrow_context(without([](auto& b) { b.contexts.current = nullptr; })),
                    Contains("contexts.current must be given"));
  CHECK_THROWS_WITH(borrow_context(without([](auto& b) { b.contexts.make_current = nullptr; })),
                    Contains("contexts.make_current must be given"));
  CHECK_THROWS_AS(borrow_context(without([](auto& b) { b.function = nullptr; })), InvalidArgument);
  CHECK_THROWS_WITH(beside_application(nullptr, application.contexts()),
                    Contains("beside_application: context must be given"));
  CHECK_THROWS_AS(beside_application(make_gl_context("osmesa"), {}), InvalidArgument);
  const auto holed = without(
      [](auto& b) { b.function = [](const char*) { return GlContext::Function{nullptr}; }; });
  CHECK_THROWS_WITH(GlRasterizer(borrow_context(holed)),
                    Contains("context window has no function"));
}

}  // namespace
}  // namespace rangezip
