#include <catch2/catch.hpp>
#include <stdexcept>

#include "core/base/error.h"
#include "raster_gl/gl_probe.h"
#include "raster_gl/osmesa_context.h"

namespace rangezip {
namespace {

using Catch::Contains;

void check_triangle(const Grid<std::uint32_t>& image) {
  REQUIRE(image.extent() == Extent{16, 16});
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      // The centre (x + 1/2, y + 1/2) against x >= 2, y >= 2, x + y <= 16.5.
      const bool inside = x >= 2 && y >= 2 && x + y <= 15;
      CAPTURE(x, y);
      CHECK(image[{x, y}] == (inside ? kProbeValue : 0U));
    }
  }
}

TEST_CASE("an OSMesa context starts, draws a triangle and reports its version") {
  const auto context = make_osmesa_context();
  CHECK(context->name() == "osmesa");
  const GlProbe result = probe(*context);
  CHECK_THAT(result.version, Contains("4.5"));
  CHECK_FALSE(result.renderer.empty());
  check_triangle(result.image);
}

TEST_CASE("contexts work side by side, again and again, and after one another's end") {
  auto first = make_osmesa_context();
  const auto second = make_osmesa_context();
  for (int round = 0; round < 3; ++round) {
    check_triangle(probe(*first).image);
    check_triangle(probe(*second).image);
  }
  first.reset();
  check_triangle(probe(*second).image);
}

TEST_CASE("no context stays current after its scope") {
  const auto context = make_osmesa_context();
  // OSMesaGetCurrentContext, from the same library.
  using GetCurrent = void* (*)();
  const auto get_current =
      reinterpret_cast<GetCurrent>(context->function("OSMesaGetCurrentContext"));
  REQUIRE(get_current != nullptr);
  CHECK(get_current() == nullptr);
  {
    const CurrentContext current(*context);
    CHECK(get_current() != nullptr);
  }
  CHECK(get_current() == nullptr);
  CHECK_THROWS_AS(
      [&] {
        const CurrentContext current(*context);
        throw std::runtime_error("while drawing");
      }(),
      std::runtime_error);
  CHECK(get_current() == nullptr);
}

TEST_CASE("a missing library is an error that names it") {
  CHECK_THROWS_AS(make_osmesa_context("libNoSuchMesa.so.8"), BackendError);
  CHECK_THROWS_WITH(make_osmesa_context("libNoSuchMesa.so.8"), Contains("libNoSuchMesa.so.8"));
}

TEST_CASE("a library that is not OSMesa is an error that names the function it lacks") {
  CHECK_THROWS_WITH(make_osmesa_context("libm.so.6"),
                    Contains("libm.so.6 has no function OSMesaCreateContextAttribs"));
}

/// A context of another driver: fails, is too old, or has a hole.
class FakeContext final : public GlContext {
 public:
  FakeContext(GlContext& real, std::string missing) : real_(real), missing_(std::move(missing)) {}

  [[nodiscard]] std::string name() const override { return "fake"; }
  [[nodiscard]] Function function(const char* name) const override {
    if (missing_ == name) return nullptr;
    if (std::string("glGetIntegerv") == name) {
      return reinterpret_cast<Function>(missing_.empty() ? &version_3_3 : &version_5_5);
    }
    return real_.function(name);
  }
  [[nodiscard]] int balance() const { return balance_; }

 private:
  static void version_3_3(unsigned /*name*/, int* value) { *value = 3; }
  static void version_5_5(unsigned /*name*/, int* value) { *value = 5; }
  void make_current() override {
    if (missing_ == "current") throw BackendError("refused");
    ++balance_;
  }
  void release() noexcept override { --balance_; }

  GlContext& real_;
  std::string missing_;
  int balance_ = 0;
};

TEST_CASE("a context that lacks a function, is too old or cannot be current is an error") {
  const auto real = make_osmesa_context();
  FakeContext holed(*real, "glDrawArrays");
  CHECK_THROWS_AS(probe(holed), BackendError);
  CHECK_THROWS_WITH(probe(holed), Contains("fake has no function glDrawArrays"));
  CHECK(holed.balance() == 0);
  FakeContext old(*real, "");
  CHECK_THROWS_WITH(probe(old), Contains("must offer OpenGL 4.5, it has 3.3"));
  CHECK(old.balance() == 0);
  FakeContext refusing(*real, "current");
  CHECK_THROWS_AS(probe(refusing), BackendError);
  CHECK(refusing.balance() == 0);
}

}  // namespace
}  // namespace rangezip
