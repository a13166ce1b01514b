// Drivers that lack something, break a rule, or fail while drawing.

#include <array>
#include <catch2/catch.hpp>
#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "core/base/error.h"
#include "raster_cpu/cpu_rasterizer.h"
#include "raster_gl/context_list.h"
#include "raster_gl/gl_buffer.h"
#include "raster_gl/gl_rasterizer.h"
#include "raster_gl/self_test.h"
#include "tests/support/lattice.h"
#include "tests/support/wrong_rasterizers.h"

namespace rangezip {
namespace {

using Catch::Contains;

/// Set by a test; the functions of OpenGL have no object.
unsigned next_error = 0;
unsigned error_after = 0;
unsigned reset_status = 0;
bool hides_int64 = false;
bool loses_mapped = false;
const unsigned char* (*real_get_stringi)(unsigned, unsigned) = nullptr;

unsigned get_error() {
  return std::exchange(next_error, std::exchange(error_after, 0U));
}
unsigned get_reset_status() {
  return reset_status;
}
const unsigned char* get_stringi(unsigned name, unsigned index) {
  const unsigned char* const text = real_get_stringi(name, index);
  const bool is_hidden = hides_int64 && std::strcmp(reinterpret_cast<const char*>(text),
                                                    "GL_ARB_gpu_shader_int64") == 0;
  return is_hidden ? reinterpret_cast<const unsigned char*>("GL_EXT_nothing") : text;
}
unsigned char (*real_unmap)(unsigned) = nullptr;
unsigned char unmap(unsigned buffer) {
  real_unmap(buffer);
  return loses_mapped ? 0 : 1;
}
void draw_nothing(unsigned /*x*/, unsigned /*y*/, unsigned /*z*/) {}

/// OSMesa with some functions of its own.
class FaultyContext final : public GlContext {
 public:
  explicit FaultyContext(bool draws = true) : draws_(draws) {
    next_error = 0;
    error_after = 0;
    reset_status = 0;
    hides_int64 = false;
    loses_mapped = false;
  }
  [[nodiscard]] std::string name() const override { return "faulty"; }
  [[nodiscard]] Function function(const char* name) const override {
    const std::string wanted = name;
    if (wanted == "glGetError") return reinterpret_cast<Function>(&get_error);
    if (wanted == "glGetGraphicsResetStatus") return reinterpret_cast<Function>(&get_reset_status);
    if (wanted == "glDispatchCompute" && !draws_) return reinterpret_cast<Function>(&draw_nothing);
    if (wanted == "glGetStringi") {
      real_get_stringi =
          reinterpret_cast<decltype(real_get_stringi)>(real_->function("glGetStringi"));
      return reinterpret_cast<Function>(&get_stringi);
    }
    if (wanted == "glUnmapNamedBuffer") {
      real_unmap = reinterpret_cast<decltype(real_unmap)>(real_->function(name));
      return reinterpret_cast<Function>(&unmap);
    }
    return real_->function(name);
  }

 private:
  void make_current() override { current_ = std::make_unique<CurrentContext>(*real_); }
  void release() noexcept override { current_.reset(); }

  std::unique_ptr<GlContext> real_ = make_gl_context("osmesa");
  std::unique_ptr<CurrentContext> current_;
  bool draws_;
};

TEST_CASE("out of memory and the loss of the context are errors that say so") {
  GlRasterizer rasterizer(std::make_unique<FaultyContext>());
  constexpr Extent kExtent{6, 5};
  const View view = lattice::view(kExtent);
  const std::vector<Vec3f> positions{{1, 1, 1}};
  const std::vector<DrawItem> items{lattice::points(kExtent, positions)};
  constexpr unsigned kOutOfMemory = 0x0505;
  constexpr unsigned kInvalidValue = 0x0501;
  constexpr unsigned kGuiltyReset = 0x8253;
  next_error = kOutOfMemory;
  CHECK_THROWS_AS(rasterizer.render(view, items), BackendError);
  next_error = kOutOfMemory;
  CHECK_THROWS_WITH(rasterizer.render(view, items), Contains("out of memory"));
  next_error = kInvalidValue;
  Grid<PixelMoments> sums;
  CHECK_THROWS_WITH(rasterizer.accumulate(view, items, lattice::whole_window(kExtent, 0, 4), sums),
                    Contains("invalid value"));
  // Of two errors the first is told, and the other is gone.
  next_error = kOutOfMemory;
  error_after = kInvalidValue;
  CHECK_THROWS_WITH(rasterizer.render(view, items), Contains("out of memory"));
  CHECK_NOTHROW(rasterizer.render(view, items));
  reset_status = kGuiltyReset;
  CHECK_THROWS_WITH(rasterizer.render(view, items), Contains("the context was lost"));
  reset_status = 0;
  loses_mapped = true;
  CHECK_THROWS_WITH(rasterizer.render(view, items), Contains("what was read is lost"));
  // What was an error of one drawing is none of the next.
  loses_mapped = false;
  CHECK(rasterizer.render(view, items).id[{0, 0}] == 0);
}

TEST_CASE(
    "a buffer that the driver has no memory for is an error with its size, and the next is none") {
  for (const char* name : {"osmesa", "egl:surfaceless"}) {
    CAPTURE(name);
    const auto context = make_gl_context(name);
    const CurrentContext current(*context);
    const GlDevice device(current, {});
    GlBuffer buffer(device);
    constexpr std::size_t kPetabyte = std::size_t{1} << 50;
    CHECK_THROWS_AS(buffer.reserve(kPetabyte, "the cloud"), BackendError);
    CHECK_THROWS_WITH(buffer.reserve(kPetabyte, "the cloud"),
                      Contains("1125899906842624 bytes for the cloud: out of memory; the driver "
                               "says: GL_OUT_OF_MEMORY"));
    const std::array<std::uint32_t, 2> values{7, 8};
    std::array<std::uint32_t, 2> read{};
    buffer.upload(std::span(values), "two numbers");
    buffer.download(std::span(read));
    CHECK(read == values);
  }
}

TEST_CASE("a driver without 64-bit integers is refused with the name of the extension") {
  auto context = std::make_unique<FaultyContext>();
  hides_int64 = true;
  CHECK_THROWS_WITH(GlRasterizer(std::move(context)), Contains("GL_ARB_gpu_shader_int64"));
}

TEST_CASE("a driver that draws wrongly is refused with the rule that it breaks") {
  CHECK_THROWS_AS(GlRasterizer(std::make_unique<FaultyContext>(false)), BackendError);
  CHECK_THROWS_WITH(GlRasterizer(std::make_unique<FaultyContext>(false)),
                    Contains("breaks rule R5, the pixels of a point: "));
}

TEST_CASE("the self-test finds nothing wrong with the reference") {
  for (const std::string& instructions : cpu_instructions()) {
    CpuRasterizer reference(instructions);
    CHECK(find_broken_rule(reference) == std::nullopt);
  }
}

TEST_CASE("the self-test names the rule that a rasterizer breaks") {
  const std::map<std::string, std::string> rules{
      {"other_edges_own_ties", "R6"},  {"depth_rounds_to_nearest", "R7"},
      {"quotient_in_float", "R4"},     {"halves_go_down", "R4"},
      {"ties_go_to_higher_id", "R9"},  {"points_lean_left", "R5"},
      {"denormals_are_zero", "R2"},    {"band_is_open", "R12"},
      {"shift_rounds_to_zero", "R13"}, {"parts_lose_their_last", "R5"},
      {"votes_are_lost", "R13"},       {"ties_go_to_the_later_part", "R9"}};
  const auto make_right = [] { return std::make_unique<CpuRasterizer>("scalar"); };
  for (const WrongRasterizer& wrong : wrong_rasterizers(make_right)) {
    CAPTURE(wrong.name);
    REQUIRE(rules.count(wrong.name) == 1);
    const auto rasterizer = wrong.make();
    const std::string broken = find_broken_rule(*rasterizer).value_or("none");
    CHECK_THAT(broken, Catch::StartsWith(rules.at(wrong.name) + ", "));
  }
}

}  // namespace
}  // namespace rangezip
