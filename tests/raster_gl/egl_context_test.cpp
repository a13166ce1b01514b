#include <catch2/catch.hpp>
#include <cstdlib>
#include <map>
#include <string>
#include <thread>

#include "core/base/error.h"
#include "raster_gl/context_list.h"
#include "raster_gl/egl_context.h"
#include "raster_gl/gl_probe.h"
#include "raster_gl/osmesa_context.h"

namespace rangezip {
namespace {

using Catch::Contains;

/// Pixels that the triangle of probe() covers: x >= 2, y >= 2, x + y <= 15.
void check_probe(GlContext& context) {
  const GlProbe result = probe(context);
  CHECK_THAT(result.version, Contains("4.5"));
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      const bool inside = x >= 2 && y >= 2 && x + y <= 15;
      CHECK(result.image[{x, y}] == (inside ? kProbeValue : 0U));
    }
  }
}

TEST_CASE("a context of EGL without surfaces starts and draws a triangle") {
  const auto context = make_egl_surfaceless_context();
  CHECK(context->name() == "egl:surfaceless");
  check_probe(*context);
}

TEST_CASE("every device of EGL starts and draws a triangle, and there is one") {
  const int devices = count_egl_devices();
  REQUIRE(devices >= 1);
  for (int device = 0; device < devices; ++device) {
    const auto context = make_egl_device_context(device);
    CHECK(context->name() == "egl:" + std::to_string(device));
    check_probe(*context);
  }
}

TEST_CASE("a device that is not there is an error with its number") {
  CHECK_THROWS_AS(make_egl_device_context(-1), BackendError);
  CHECK_THROWS_WITH(make_egl_device_context(999), Contains("no device 999"));
}

TEST_CASE("a library that is missing or not EGL is an error that names it") {
  CHECK_THROWS_WITH(make_egl_surfaceless_context("libNoSuchEGL.so.1"),
                    Contains("cannot open libNoSuchEGL.so.1"));
  CHECK_THROWS_WITH(make_egl_device_context(0, "libm.so.6"),
                    Contains("libm.so.6 has no function eglBindAPI"));
  CHECK_THROWS_AS(count_egl_devices("libNoSuchEGL.so.1"), BackendError);
}

/// Makes a context of the library in fake_egl.cpp, with one fault, current.
void use_faulty_egl(const std::string& fault) {
  REQUIRE(setenv("RANGEZIP_FAKE_EGL", fault.c_str(), 1) == 0);
  const auto context = make_egl_device_context(0, RANGEZIP_FAKE_EGL);
  const CurrentContext current(*context);
}

TEST_CASE("an EGL without a driver for us is an error that says what it lacks") {
  const std::map<std::string, std::string> errors{
      {"no platforms", "EGL: there is no extension EGL_EXT_device_enumeration"},
      {"no device", "EGL: there is no device 0, only 0 in all"},
      {"no display", "EGL: there is no display without a screen (error 0x3009)"},
      {"display does not start", "EGL: the display does not start (error 0x3009)"},
      {"needs surfaces", "EGL: there is no extension EGL_KHR_surfaceless_context"},
      {"old OpenGL", "EGL: there is no OpenGL 4.5 core context (error 0x3009)"},
      {"not current", "EGL: the context cannot be made current (error 0x3009)"}};
  for (const auto& [fault, error] : errors) {
    CAPTURE(fault);
    CHECK_THROWS_AS(use_faulty_egl(fault), BackendError);
    CHECK_THROWS_WITH(use_faulty_egl(fault), Catch::StartsWith(error));
  }
  for (const char* harmless : {"none", "older name"})
    CHECK_NOTHROW(use_faulty_egl(harmless));
}

TEST_CASE("contexts are made by name, and an unknown name is refused with the known ones") {
  for (const std::string& name : list_gl_contexts()) {
    CAPTURE(name);
    const auto context = make_gl_context(name);
    CHECK(context->name() == name);
    check_probe(*context);
  }
  CHECK(make_gl_context("egl")->name() == "egl:0");
  CHECK(make_gl_context("") != nullptr);
  for (const char* name : {"mesa", "egl:", "egl:x", "egl:1x", "egl:-"}) {
    CAPTURE(name);
    CHECK_THROWS_WITH(make_gl_context(name), Contains("known: osmesa, egl, egl:N"));
  }
}

TEST_CASE("a context works on another thread than the one that made it") {
  const auto egl = make_egl_surfaceless_context();
  const auto osmesa = make_osmesa_context();
  std::thread([&] {
    check_probe(*egl);
    check_probe(*osmesa);
  }).join();
  check_probe(*egl);
  check_probe(*osmesa);
}

}  // namespace
}  // namespace rangezip
